#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "coupler/accuracy/scene_tree.hpp"

/// Stands in for talus: "computes" a coupled scene whose errors are known. Called as `fake_run run SCENE
/// --out DIR ...`.
///
/// The peak of net.z is 3 plus, for each side, the window and the mesh, factor (size/1 ms or 1 m)^order; the
/// constants stand in the scene's section `model`. A strong scheme divides the window's error by a hundred
/// and takes three times as long; implicit contact divides the particles' by ten at 1.2 times their cost.
/// Friction of contacts[0] changes the peak by model.friction and shows in its line of the ledger. Each run
/// adds a line to <folder of the scene it extends>/order.txt.
namespace {

using nlohmann::json;
using talus::accuracy::node_at;

class Scene {
 public:
  explicit Scene(const std::filesystem::path& file)
      : tree_(talus::accuracy::effective_tree(talus::core::SceneFile::load(file))) {}
  bool has(const std::string& key) const { return node_at(tree_, key) != nullptr; }
  double number(const std::string& key, double otherwise, const char* unit = "") const {
    const auto* node = node_at(tree_, key);
    return node ? talus::core::parse_quantity(node->scalar, unit).value_or(otherwise) : otherwise;
  }
  double seconds(const std::string& key, double otherwise) const { return number(key, otherwise, "s"); }

 private:
  talus::core::SceneNode tree_;
};

struct Steps {
  double window, structure, particles;  // s
};

Steps steps_of(const Scene& scene) {
  const double step = scene.seconds("time.step", 1e-3), window = scene.seconds("coupling.window", step);
  return {window, scene.seconds("structure.step", step), scene.seconds("particles.step", step)};
}

double error(const Scene& scene, const std::string& cause, double size) {
  const std::string key = "model." + cause;
  if (!scene.has(key)) return 0;
  return scene.number(key + ".factor", 0) * std::pow(size, scene.number(key + ".order", 1));
}

double peak(const Scene& scene, const Steps& steps) {
  double value = 3 + error(scene, "structure", steps.structure / 1e-3);
  value +=
      error(scene, "particles", steps.particles / 1e-3) * (scene.has("particles.implicit_contact") ? 0.1 : 1);
  value += error(scene, "window", steps.window / 1e-3) * (scene.has("coupling.serial_implicit") ? 0.01 : 1);
  value += error(scene, "mesh", scene.number("structure.parts.sheet.sheet.element_size", 1, "m"));
  if (!scene.has("particles.contacts[0].friction")) value += scene.number("model.friction", 0);
  // The neighbours of the scene: heavier and faster rocks go deeper.
  value *= scene.number("particles.spheres.rock.velocity[2]", -1, "m/s") / -1;
  return value;
}

double wall_time(const Scene& scene, const Steps& steps) {
  const double structure = scene.number("model.cost.structure", 1e-3) / steps.structure,
               particles = scene.number("model.cost.particles", 1e-3) / steps.particles,
               window = scene.number("model.cost.window", 0) / steps.window;
  const double friction = scene.has("particles.contacts[0].friction") ? 2 : 1;
  const double all =
      structure + particles * friction * (scene.has("particles.implicit_contact") ? 1.2 : 1) + window;
  return all * (scene.has("coupling.serial_implicit") ? 3 : 1);
}

json limits(const Scene& scene, const Steps& steps) {
  json all = json::array();
  for (const auto& [side, step] :
       {std::pair("structure", steps.structure), std::pair("particles", steps.particles)}) {
    const double limit = scene.seconds(std::string("model.limit.") + side, 1);
    all.push_back({{"side", side},
                   {"name", "limit"},
                   {"kind", "stability"},
                   {"limit_s", limit},
                   {"step_s", step},
                   {"exceeded", step > limit}});
  }
  return all;
}

int compute(const Scene& scene, const std::filesystem::path& out) {
  const Steps steps = steps_of(scene);
  const json checked = limits(scene, steps);
  for (const auto& limit : checked)
    if (limit.at("exceeded").get<bool>()) {
      fmt::print(stderr, "the step of {} is above the stability limit\n",
                 limit.at("side").get<std::string>());
      return static_cast<int>(talus::core::ExitCode::config);
    }
  std::filesystem::create_directories(out);
  const double value = peak(scene, steps), seconds = wall_time(scene, steps);
  json summary{
      {"status", "finished"},
      {"window_s", steps.window},
      {"wall_time_s", seconds},
      {"simulated_time_s", 1},
      {"limits", checked},
      {"step_s", {{"structure", steps.structure}, {"particles", steps.particles}}},
      {"peaks", {{"net.z", {{"value", value}, {"time_s", 0.5}}}}},
      {"energy", {{"largest_error_relative", error(scene, "energy", steps.window / 1e-3)}, {"impact_J", 1}}},
      {"effects", json::array()},
      {"warnings", json::array()},
      {"last", json::object()}};
  if (scene.has("particles.contacts[0].friction"))
    summary["effects"].push_back({{"side", "particles"},
                                  {"name", "friction"},
                                  {"present", true},
                                  {"key", "particles.contacts[0].friction"},
                                  {"ledger_line", "contacts.friction_J"},
                                  {"may_hold", false},
                                  {"limit", ""},
                                  {"reason", ""}});
  summary["scheme"] = scene.has("coupling.serial_implicit") ? "serial_implicit" : "serial_explicit";
  if (scene.has("coupling.serial_implicit"))
    summary["iterations"] = {
        {"mean", 3}, {"total", 3}, {"windows", 1}, {"windows_not_converged", 0}, {"windows_halved", 0}};
  std::ofstream(out / "summary.json") << summary.dump();
  std::ofstream(out / "probes.csv") << fmt::format("time_s,net.z\n0,{0}\n0.5,{1}\n1,{0}\n",
                                                   value - scene.number("model.rows", 0), value);
  std::ofstream(out / "energy.csv") << "time_s,contacts.friction_J\n0,0\n1,1e-9\n";
  return 0;
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path scene = arguments[2];
  try {
    return compute(Scene(scene), arguments[4]);
  } catch (const talus::core::ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(talus::core::ExitCode::config);
  }
}
