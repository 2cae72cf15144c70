#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"

/// Stands in for talus: "computes" a scene whose errors are known. Called as `fake_talus run SCENE --out DIR
/// ...`, with SCENE in <test>/out/runs/<point>/. Adds the point to <test>/order.txt; where <test>/trouble is, it is
/// killed, as by a machine without memory.
namespace {

struct Model {
  double step = 1;
  double order = 2;
  double unstable_from = 1e9;
  bool hangs = false;
  double not_converged = 0;
  double energy_factor = 1;
};
void describe(talus::core::Fields& fields, Model& model) {
  fields.required("step", model.step, {.unit = "s", .help = "h"});
  fields.with_default("order", model.order, {.help = "p"});
  fields.with_default("unstable_from", model.unstable_from, {.unit = "s", .help = "limit of the step"});
  fields.with_default("hangs", model.hangs, {.help = "never ends"});
  fields.with_default("not_converged", model.not_converged, {.help = "of 200 windows"});
  fields.with_default("energy_factor", model.energy_factor,
                      {.help = "of the energy error, which is the step"});
}

/// @throws ConfigError
Model read_model(const std::filesystem::path& scene) {
  const auto file = talus::core::SceneFile::load(scene);
  talus::core::SceneReader reader(file, {"model", "extends", "mesh"});
  const auto model = reader.required<Model>("model");
  reader.finish();
  return model;
}

int compute(const Model& model, const std::filesystem::path& out) {
  if (model.hangs) std::this_thread::sleep_for(std::chrono::hours(1));
  if (model.step >= model.unstable_from) {
    fmt::print(stderr, "some words\nit blew up\n");
    return static_cast<int>(talus::core::ExitCode::numerical);
  }
  std::filesystem::create_directories(out);
  const double value = 3 + std::pow(model.step, model.order);
  std::ofstream(out / "summary.json") << fmt::format(
      R"({{"wall_time_s": {}, "peaks": {{"net.z": {{"value": {}, "time_s": 1}}}}, "energy": {{"largest_error_relative": {}}},
      "work": {{"solver_calls": 7}}, "warnings": [{}],
      "iterations": {{"mean": 2, "total": 400, "windows_not_converged": {}}}}})",
      1e-3 / model.step, value, model.energy_factor * model.step,
      model.not_converged > 0 ? "\"windows did not converge\"" : "", model.not_converged);
  std::ofstream(out / "probes.csv") << fmt::format("time_s,net.z\n0,0\n1,{}\n2,{}\n", value, 2 * value);
  return 0;
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path scene = arguments[2], point = scene.parent_path(),
                              test = point.parent_path().parent_path().parent_path();
  std::ofstream(test / "order.txt", std::ios::app) << point.stem().string() << "\n";
  if (std::filesystem::exists(test / "trouble")) std::raise(SIGKILL);
  try {
    return compute(read_model(scene), arguments[4]);
  } catch (const talus::core::ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(talus::core::ExitCode::config);
  }
}
