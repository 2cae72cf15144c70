#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"

/// Stands in for talus: "computes" a scene whose errors are known. Called as `fake_talus run SCENE --out DIR
/// ...`.
namespace {

struct Model {
  double step = 1;
  double order = 2;
  double unstable_from = 1e9;
  bool hangs = false;
};
void describe(talus::core::Fields& fields, Model& model) {
  fields.required("step", model.step, {.unit = "s", .help = "h"});
  fields.with_default("order", model.order, {.help = "p"});
  fields.with_default("unstable_from", model.unstable_from, {.unit = "s", .help = "limit of the step"});
  fields.with_default("hangs", model.hangs, {.help = "never ends"});
}

}  // namespace

int main(int, char** arguments) {
  const auto file = talus::core::SceneFile::load(arguments[2]);
  talus::core::SceneReader reader(file, {"model", "extends"});
  const auto model = reader.required<Model>("model");
  if (model.hangs) std::this_thread::sleep_for(std::chrono::hours(1));
  if (model.step >= model.unstable_from) {
    fmt::print(stderr, "some words\nit blew up\n");
    return static_cast<int>(talus::core::ExitCode::numerical);
  }
  const std::filesystem::path out = arguments[4];
  std::filesystem::create_directories(out);
  const double value = 3 + std::pow(model.step, model.order);
  std::ofstream(out / "summary.json") << fmt::format(
      R"({{"wall_time_s": {}, "peaks": {{"net.z": {{"value": {}, "time_s": 1}}}}, "energy": {{"error_relative": {}}}, "work": {{"solver_calls": 7}}}})",
      1e-3 / model.step, value, model.step);
  std::ofstream(out / "probes.csv") << fmt::format("time_s,net.z\n0,0\n1,{}\n2,{}\n", value, 2 * value);
  std::ofstream(std::filesystem::path(arguments[2]).parent_path() / "count.txt", std::ios::app) << "x";
}
