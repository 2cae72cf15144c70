#include "coupler/scene/coupled_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "core/steps.hpp"
#include "core/units/units.hpp"

namespace talus::coupler {
namespace {

/// The rest of a side's section is its solver's business, complaints included.
std::optional<core::SolverScene> read_side(const core::SceneFile& file, const std::string& section,
                                           std::vector<core::Complaint>& complaints) {
  if (!file.has_section(section)) return std::nullopt;
  std::optional<core::SolverScene> solver;
  std::vector<core::Complaint> all;
  file.read(
      section, core::Presence::optional,
      [&](core::Fields& fields) { fields.section("solver", solver, "the program of this side"); }, all);
  for (auto& complaint : all) {
    if (complaint.key_path.starts_with(section + ".solver")) complaints.push_back(std::move(complaint));
  }
  return solver.value_or(core::SolverScene{});
}

template <class Section>
void read_section(const core::SceneFile& file, const char* key, core::Presence presence, Section& section,
                  std::vector<core::Complaint>& complaints) {
  file.read(
      key, presence, [&](core::Fields& fields) { describe(fields, section); }, complaints);
}

using Complain = std::function<void(const char* key, const std::string& message)>;

/// What has to hold between keys of different sections.
void check_windows(const CoupledScene& scene, const Complain& complain) {
  if (scene.coupling.longest_window && !scene.interface)
    complain("coupling.longest_window", "needs an interface, without which nothing can touch");
  if (scene.window() <= 0) {
    const bool needed = scene.structure && scene.particles;
    if (needed) complain("time.step", "is missing, and so is 'coupling.window'");
    return;
  }
  if (scene.coupling.longest_window && scene.longest_window() < 2)
    complain("coupling.longest_window",
             fmt::format("must be at least two windows of {}", core::readable(scene.window(), "s")));
  const ImplicitScene* implicit = scene.coupling.implicit();
  if (implicit != nullptr && implicit->shortest_window && scene.most_halvings() < 1)
    complain(std::holds_alternative<SerialImplicitScene>(scene.coupling.scheme)
                 ? "coupling.serial_implicit.shortest_window"
                 : "coupling.parallel_implicit.shortest_window",
             fmt::format("must be at most half a window of {}", core::readable(scene.window(), "s")));
}

constexpr double round_off = core::whole_ratio;

}  // namespace

double CoupledScene::window() const {
  return named_window() > 0 ? core::equal_steps(time.end, named_window()).length : 0;
}

std::int64_t CoupledScene::longest_window() const {
  if (!coupling.longest_window) return 1;
  return static_cast<std::int64_t>(*coupling.longest_window / window() * (1 + round_off));
}

std::int64_t CoupledScene::most_halvings() const {
  const ImplicitScene* implicit = coupling.implicit();
  if (implicit == nullptr || !implicit->shortest_window) return 0;
  return std::ilogb(window() / *implicit->shortest_window * (1 + round_off));
}

CoupledScene read_coupled_scene(const core::SceneFile& file, std::vector<core::Complaint>& complaints) {
  using core::Presence;
  CoupledScene scene;
  file.check_sections(core::scene_sections(), complaints);
  read_section(file, "time", Presence::required, scene.time, complaints);
  read_section(file, "output", Presence::optional, scene.output, complaints);
  read_section(file, "coupling", Presence::optional, scene.coupling, complaints);
  if (file.has_section("interface"))
    read_section(file, "interface", Presence::optional, scene.interface.emplace(), complaints);
  scene.structure = read_side(file, "structure", complaints);
  scene.particles = read_side(file, "particles", complaints);

  const Complain complain = [&](const char* key, const std::string& message) {
    complaints.push_back({.file = file.path(), .key_path = key, .message = message});
  };
  if (!scene.structure && !scene.particles)
    complain("", "has neither a section 'structure' nor a section 'particles'");
  if (scene.interface && !(scene.structure && scene.particles)) {
    complain("interface", "needs both a structure and particles, but the scene has only one of them");
  }
  core::log_warnings(complaints);
  if (complaints.empty()) check_windows(scene, complain);
  return scene;
}

}  // namespace talus::coupler
