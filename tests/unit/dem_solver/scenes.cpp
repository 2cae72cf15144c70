#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "dem_solver/app/particle_run.hpp"
#include "dem_solver/app/standalone.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

#include "dem_solver/rocks/closed_surface.hpp"
#include "dem_solver/scene/build_model.hpp"
#include "dem_solver/scene/overlap_check.hpp"
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

TEST_CASE("The examples of the particle side run alone and write their results") {
  const std::string name =
      GENERATE("bouncing_spheres", "rocks_and_stones", "rolling_on_triangles", "stones_down_a_slope");
  const test::Folder folder("dem_" + name);
  core::SolverCommand command;
  command.scene = std::string(TALUS_SOURCE_DIR) + "/configs/examples/" + name + ".yaml";
  command.run.out = folder / "result";
  command.run.progress = core::ProgressStyle::quiet;
  CHECK(dem::run_standalone(command) == core::ExitCode::success);
  for (const char* file : {"summary.json", "probes.csv", "energy.csv"})
    CHECK(std::filesystem::exists(folder / (std::string("result/") + file)));
}

TEST_CASE("Bad particle scenes are refused with a message that says what to do") {
  using Catch::Contains;
  const std::string contacts = "  contacts: [{between: [rock, rock], hertz: {restitution: 0.5}}]\n";
  const auto text = [&](const std::string& more) {
    dem::ParticlesScene scene;
    return test::complaints_about(scene_with(contacts + more), scene, "particles");
  };
  CHECK_THAT(text("  spheres: {a: {material: sand, radius: 0.1, at: [0, 0, 0]}}\n"),
             Contains("there is no material `sand`"));
  CHECK_THAT(text("  spheres: {a: {material: wall, radius: 0.1, at: [0, 0, 0]}}\n"),
             Contains("has no density"));
  CHECK_THAT(text("  spheres: {a: {material: rock, radius: -0.1, at: [0, 0, 0]}}\n"), Contains("radius"));
  CHECK_THAT(text("  streams: {s: {material: rock, count: 1000000, radius: [0.1], low: [0, 0, 0], high: [1, "
                  "1, 1]}}\n"),
             Contains("the box has room for 125 spheres"));
  CHECK_THAT(text("  gates: {probes: {point: [0, 0, 0], normal: [0, 0, 1]}}\n"),
             Contains("particles.gates") && Contains("may not be named `probes`"));
}

TEST_CASE(
    "few spheres in a box of very many places are all over it, none in the place of another") {  // of 1e11
  dem::StreamScene stream{.material = "rock",
                          .count = 2000,
                          .radius = {0.05},
                          .low = {0, 0, 0},
                          .high = {600, 600, 300},
                          .seed = 3};
  const auto spheres = dem::make_stream(stream, 2500);
  REQUIRE(spheres.size() == 2000);
  core::Vector3 mean = core::Vector3::Zero();
  for (const auto& s : spheres) {
    const core::Vector3 at(s.position.x, s.position.y, s.position.z);
    CHECK(((at.array() >= 0.05) && (at.array() <= stream.high.array() - 0.05)).all());
    mean += at / 2000;
  }
  // Of uniform places: half of the box, to four standard errors, extent/sqrt(12 n) = 0.65 % of the extent.
  for (int k = 0; k < 3; ++k) CHECK(std::abs(mean[k] / stream.high[k] - 0.5) < 4 * 0.0065);
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const core::Vector3 apart(spheres[i].position.x - spheres[j].position.x,
                                spheres[i].position.y - spheres[j].position.y,
                                spheres[i].position.z - spheres[j].position.z);
      if (apart.norm() < 0.1) FAIL("two spheres overlap");
    }
}

TEST_CASE("Angles as coefficients, frequencies as spins and other lost units of particles are refused") {
  using Catch::Contains;
  dem::ParticlesScene scene;
  const auto text = [&](const std::string& friction, const std::string& spin, const std::string& material) {
    return test::complaints_about(
        "particles:\n"
        "  materials: {rock: {" +
            material +
            "}}\n"
            "  contacts: [{between: [rock, rock], hertz: {restitution: 0.5}, "
            "friction: {coefficient: " +
            friction +
            "}}]\n"
            "  spheres: {a: {material: rock, radius: 10 cm, at: [0, 0, 0], spin: [0, 0, " +
            spin + "]}}\n",
        scene, "particles");
  };
  const std::string rock = "density: 2.7 g/cm^3, youngs_modulus: 1e7, poissons_ratio: 0.2";
  REQUIRE(text("0.5", "3 rpm", rock).empty());
  CHECK(scene.spheres[0].second.spin.z() == Approx(2 * std::acos(-1.0) * 3 / 60).epsilon(1e-14));
  CHECK_THAT(text("30 deg", "0", rock), Contains("coefficient: expects a plain number, got '30 deg'") &&
                                            Contains("its tangent is 0.57735"));
  CHECK_THAT(text("30", "0", rock), Contains("coefficient: is 30, but must be at most 5"));
  for (const char* rate : {"3 Hz", "3 1/s", "180 1/min"})
    CHECK_THAT(text("0.5", rate, rock), Contains("a frequency; where turns are meant, write '3 turn/s'"));
  CHECK_THAT(text("0.5", "3 deg", rock), Contains("spin[2]: expects an angular velocity"));
  CHECK_THAT(text("0.5", "0", "density: 2700, youngs_modulus: 1e7, poissons_ratio: 14 deg"),
             Contains("poissons_ratio: expects a plain number, got '14 deg', which is an angle"));
  CHECK_THAT(text("0.5", "0", "density: 2700, youngs_modulus: 50000 mPa, poissons_ratio: 0.2"),
             Contains("youngs_modulus: '50000 mPa' is 50 Pa, but must be") && Contains("written MPa"));
  CHECK_THAT(text("0.5", "0", "density: 2700 t/mm^3, youngs_modulus: 1e7, poissons_ratio: 0.2"),
             Contains("density: '2700 t/mm^3' is"));
}

TEST_CASE("A probe of a rock that is not there, or of a structure that is not, is refused") {
  const auto error = [](const std::string& probe) -> std::string {
    try {
      dem::read_run_scene(core::SceneFile::parse(
          "time: {end: 1 s, step: 1 ms}\n" +
              scene_with("  contacts: [{between: [rock, rock], hertz: {restitution: 0.5}}]\n"
                         "  spheres: {boulder: {material: rock, radius: 0.1, at: [0, 0, 0]}}\n") +
              "output: {probes: {one: " + probe + "}}\n",
          "scene.yaml"));
    } catch (const core::ConfigError& refused) {
      return refused.what();
    }
    return {};
  };
  CHECK(error("{rock: boulder}").empty());
  CHECK(error("{rock: bolder}") ==
        "scene.yaml: output.probes.one.rock: there is no sphere or rock 'bolder'; known: boulder");
  CHECK(error("{at: [0, 0, 0]}") ==
        "scene.yaml: output.probes.one: watches a structure, and the scene has none");
}

namespace {

/// A tetrahedron with three edges along the axes, from a corner on; facing outwards.
void add_tetrahedron(mesh::Surface& surface, const core::Vector3& corner) {
  const mesh::Index first = surface.node_count();
  for (const core::Vector3& p :
       {core::Vector3(0, 0, 0), core::Vector3(1, 0, 0), core::Vector3(0, 1, 0), core::Vector3(0, 0, 1)})
    for (int k = 0; k < 3; ++k) surface.positions.push_back(corner[k] + p[k]);
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    surface.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

TEST_CASE("Surfaces that are no rock are refused with the place of the fault") {
  using Catch::Contains;
  mesh::Surface apart, crossing;
  add_tetrahedron(apart, {0, 0, 0});
  add_tetrahedron(apart, {5, 0, 0});
  CHECK_THAT(dem::closed_surface_fault(apart), Contains("is 2 separate bodies"));
  add_tetrahedron(crossing, {0, 0, 0});
  add_tetrahedron(crossing, {0.1, 0.2, 0.3});
  CHECK_THAT(dem::closed_surface_fault(crossing), Contains("reach into each other: triangles"));
  mesh::Surface alone;
  add_tetrahedron(alone, {5, 0, 0});
  CHECK(dem::closed_surface_fault(alone).empty());
  mesh::Surface inside_out = alone;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  CHECK_THAT(dem::closed_surface_fault(inside_out), Contains("turned inside out"));
  mesh::Surface open = apart;
  open.triangles.pop_back();
  CHECK_THAT(dem::closed_surface_fault(open), Contains("is not closed: the edge from (6, 0, 0) m"));
}

TEST_CASE("Triangles without area and wires without length are refused as boundaries") {
  using Catch::Contains;
  const auto surface_of = [](const std::vector<core::Vector3>& positions, const dem::NodesScene& cells) {
    dem::BoundaryScene boundary;
    dem::NodesScene nodes = cells;
    nodes.positions = positions;
    boundary.shape = nodes;
    return dem::make_surface({{"slope", boundary}});
  };
  const std::vector<core::Vector3> straight{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, same{{1, 2, 3}, {1, 2, 3}};
  CHECK_THROWS_WITH(surface_of(straight, {.positions = {}, .segments = {}, .triangles = {0, 1, 2}}),
                    Contains("particles.boundaries.slope") && Contains("has no area"));
  CHECK_THROWS_WITH(surface_of(same, {.positions = {}, .segments = {0, 1}, .triangles = {}}),
                    Contains("particles.boundaries.slope"));
}

TEST_CASE("Rocks that overlap at the start are refused with their depth") {
  dem::ParticlesScene scene;
  const std::string text =
      "  contacts: [{between: [rock, rock], hertz: {restitution: 0.5}}]\n"
      "  rocks:\n"
      "    a: {material: rock, block: {edge: 1, deviation: 0.1}, at: [0, 0, 0]}\n"
      "    b: {material: rock, block: {edge: 1, deviation: 0.1}, at: [0.75, 0, 0]}\n";
  REQUIRE(test::complaints_about(scene_with(text), scene, "particles").empty());
  // The largest sphere of a block of edge 1 touches its faces: the blocks' overlap by a quarter of the edge.
  CHECK_THROWS_WITH(dem::build_model(scene, {}, {.step = 1e-5}),
                    Catch::Contains("overlap at time 0; the deepest by 0.25 m"));
}

TEST_CASE("Spheres that overlap at the start are refused with their depth") {
  const std::vector<dem::SphereInput> spheres{
      {.position = {0, 0, 0}, .velocity = {}, .spin = {}, .radius = 1, .mass = 1},
      {.position = {1.5, 0, 0}, .velocity = {}, .spin = {}, .radius = 1, .mass = 1}};
  CHECK_THROWS_WITH(dem::check_overlaps(spheres), Catch::Contains("by 0.5 m"));
}
