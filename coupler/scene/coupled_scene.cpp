#include "coupler/scene/coupled_scene.hpp"

namespace talus::coupler {
namespace {

void describe(core::Fields& fields, SolverScene& side) {
  fields.optional("solver", side.solver,
                  {.help = "another program that computes this side; absent: Talus's own"});
}

/// The rest of a side's section is its solver's business, complaints included.
std::optional<SolverScene> read_side(const core::SceneFile& file, const std::string& section,
                                     std::vector<core::Complaint>& complaints) {
  if (!file.has_section(section)) return std::nullopt;
  SolverScene side;
  std::vector<core::Complaint> all;
  file.read(
      section, core::Presence::optional, [&](core::Fields& fields) { describe(fields, side); }, all);
  for (auto& complaint : all) {
    if (complaint.key_path == section + ".solver") complaints.push_back(std::move(complaint));
  }
  return side;
}

template <class Section>
void read_section(const core::SceneFile& file, const char* key, core::Presence presence, Section& section,
                  std::vector<core::Complaint>& complaints) {
  file.read(
      key, presence, [&](core::Fields& fields) { describe(fields, section); }, complaints);
}

}  // namespace

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

  const auto complain = [&](const char* key, const std::string& message) {
    complaints.push_back({.file = file.path(), .key_path = key, .message = message});
  };
  if (!scene.structure && !scene.particles)
    complain("", "has neither a section 'structure' nor a section 'particles'");
  if (scene.interface && !(scene.structure && scene.particles)) {
    complain("interface", "needs both a structure and particles, but the scene has only one of them");
  }
  if (complaints.empty() && scene.window() <= 0)
    complain("time.step", "is missing, and so is 'coupling.window'");
  return scene;
}

}  // namespace talus::coupler
