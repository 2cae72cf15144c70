#include <catch2/catch.hpp>

#include "dem_solver/app/standalone.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

#include "dem_solver/scene/particles_scene.hpp"

using namespace talus;

namespace {

/// A scene of one sphere of material `rock` with the given lines added or replacing the defaults.
std::string scene_with(const std::string& lines) {
  return "particles:\n"
         "  materials:\n"
         "    rock: {density: 2500, youngs_modulus: 1e7, poissons_ratio: 0.2}\n"
         "    wall: {youngs_modulus: 1e9, poissons_ratio: 0.2}\n" +
         lines;
}

}  // namespace

TEST_CASE("A pair of materials that can meet but has no contact is named") {
  using Catch::Contains;
  const std::string spheres =
      "  spheres: {a: {material: rock, radius: 0.1, at: [0, 0, 0]}, b: {material: rock, radius: 0.1, at: [1, "
      "0, 0]}}\n";
  const auto text = [&](const std::string& more) {
    dem::ParticlesScene scene;
    return test::complaints_about(scene_with(spheres + more), scene, "particles");
  };
  CHECK_THAT(text(""), Contains("no contact between `rock` and `rock`, which can meet"));
  const std::string own = "  contacts: [{between: [rock, rock], hertz: {restitution: 0.5}}]\n";
  CHECK(text(own).empty());
  CHECK_THAT(text(own + "  planes: {floor: {material: wall, point: [0, 0, 0], normal: [0, 0, 1]}}\n"),
             Contains("no contact between `rock` and `wall`"));
}

TEST_CASE("The example of bouncing spheres runs alone and writes its result") {
  const test::Folder folder("dem_bouncing");
  core::SolverCommand command;
  command.scene = std::string(TALUS_SOURCE_DIR) + "/configs/examples/bouncing_spheres.yaml";
  command.run.out = folder / "result";
  command.run.progress = core::ProgressStyle::quiet;
  CHECK(dem::run_standalone(command) == core::ExitCode::success);
  for (const char* file : {"summary.json", "probes.csv", "energy.csv", "fields.h5", "fields.xdmf"})
    CHECK(std::filesystem::exists(folder / (std::string("result/") + file)));
}
