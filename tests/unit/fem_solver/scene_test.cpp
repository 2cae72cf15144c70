#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "core/program/log.hpp"
#include "core/scene/reader.hpp"
#include "fem_solver/app/structure.hpp"
#include "fem_solver/scene/build_model.hpp"
#include "fem_solver/scene/unheld_parts.hpp"
#include "fem_solver/scene/weld.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

namespace {

using namespace talus;
using namespace talus::fem;

using tests::complaint;
using tests::scene;

const std::string cable = "cable: {area: 1 cm^2, density: 8000, youngs_modulus: 100 GPa}";
const std::string net =
    "  parts: {net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1}, " + cable + "}}\n";
const std::string line =
    "  parts: {rope: {polyline: {points: [[0, 0, 0], [4, 0, 0]], divisions: 4}, " + cable + "}}\n";

}  // namespace

TEST_CASE("a square net of n x n openings has the nodes, cables, sets and mass that its geometry gives") {
  const Structure structure(scene(net + "  supports: [{nodes: net.rim, fix: xyz}]\n"));
  const Model& model = structure.model();
  CHECK(model.nodes() == 16);
  CHECK(std::get<CableBatch>(model.parts[0].elements).size() == 24);
  CHECK(model.node_sets.at("net.rim").size() == 12);
  double mass = 0;
  for (const double m : model.node_masses) mass += m;
  CHECK(mass == Approx(24 * 1.0 * 1e-4 * 8000));
}

TEST_CASE("welded parts share the nodes where they meet, and only those") {
  const std::string two =
      "  parts:\n    a: {polyline: {points: [[0, 0, 0], [1, 0, 0]], divisions: 2}, " + cable +
      "}\n    b: {polyline: {points: [[1, 0.0005, 0], [2, 0, 0]], divisions: 2}, " + cable + "}\n";
  CHECK(Structure(scene(two)).model().nodes() == 6);
  const Structure welded(scene(two + "  weld: {tolerance: 1 mm}\n"));
  CHECK(welded.model().nodes() == 5);
  CHECK(welded.model().node_sets.at("a.end") == welded.model().node_sets.at("b.start"));
}

TEST_CASE("a rope leads through the nodes of another part, with ends of its own") {
  const Structure structure(scene(
      "  parts:\n    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1}, " + cable +
      "}\n    rope: {through: {nodes: [net.edge_south], from: [-1, 0, 0], to: [4, 0, 0]}, " + cable + "}\n"));
  const Model& model = structure.model();
  CHECK(model.nodes() == 18);
  const auto& rope = model.node_sets.at("rope");
  REQUIRE(rope.size() == 6);
  CHECK(model.position(rope.front()).x() == -1);
  CHECK(model.position(rope.back()).x() == 4);
  CHECK(rope[1] == model.node_sets.at("net.edge_south").front());
}

TEST_CASE("a rope runs along the nodes that a box selects, whichever end it comes from") {
  const bool from_above = GENERATE(false, true);
  const std::string ends = from_above ? "from: [0, 4, 0], to: [0, -1, 0]" : "from: [0, -1, 0], to: [0, 4, 0]";
  const Structure structure(
      scene("  parts:\n    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1}, " + cable +
            "}\n    rope: {through: {nodes: [west], " + ends + "}, " + cable +
            "}\n  node_sets: {west: {box: {low: [-0.1, -0.1, -1], high: [0.1, 3.1, 1]}}}\n"));
  const Model& model = structure.model();
  const auto& rope = model.node_sets.at("rope");
  REQUIRE(rope.size() == 6);
  for (std::size_t k = 0; k < rope.size(); ++k)
    CHECK(model.position(rope[k]).y() ==
          (from_above ? 4.0 - static_cast<double>(k) : static_cast<double>(k) - 1));
}

TEST_CASE("a rope that runs to and fro is warned of with its length and the way there is") {
  const auto before = talus::core::warnings_said().size();
  const Structure structure(scene(
      "  parts:\n    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1}, " + cable +
      "}\n    rope: {through: {nodes: [net.edge_south], from: [4, 0, 0], to: [-1, 0, 0]}, " + cable + "}\n"));
  const auto said = talus::core::warnings_said();
  REQUIRE(said.size() > before);
  CHECK_THAT(said.back(),
             Catch::Contains("the rope is 11 m long, and 5 m from each node to the nearest one left"));
}

TEST_CASE("without a step the structure takes half of its limit") {
  const Structure structure(scene(line));
  CHECK(structure.step() == Approx(0.5 * std::sqrt(8000 / 1e11)).epsilon(1e-6));  // L sqrt(rho/E) of 1 m
}

TEST_CASE("a step above the limit is refused unless the scene insists") {
  CHECK_THAT(
      complaint(line + "  step: 1 ms\n"),
      Catch::Contains(
          "the step of 1 ms is above the limit of stability, 282.8 us: highest frequency of the structure"));
  CHECK(complaint(line + "  step: 1 ms\n  unstable_step: allowed\n") == "no complaint");
}

TEST_CASE("mass damping that would turn velocities round within a step is refused") {
  const std::string step = "  step: 100 us\n";
  CHECK_THAT(
      complaint(line + step + "  damping: {mass: 20100}\n"),
      Catch::Contains("a mass damping of 2.01e+04 1/s turns velocities round within the step of 100 us") &&
          Catch::Contains("at most 99.5 us"));
  CHECK(complaint(line + step + "  damping: {mass: 19900}\n") == "no complaint");
}

TEST_CASE("mass scaling of a scene makes its step stable, and other methods than explicit refuse it") {
  const std::string scaled = line + "  step: 1 ms\n  mass_scaling: {step: 1.1 ms}\n";
  const Structure structure(scene(scaled));
  CHECK(structure.bounds().front().seconds >= 1.1e-3 * (1 - 1e-9));
  CHECK(structure.added_mass().nodes == 5);
  CHECK_THAT(complaint(scaled + "  static: {}\n"), Catch::Contains("structure.mass_scaling"));
  CHECK_THAT(complaint(line + "  mass_scaling: {step: 0}\n"), Catch::Contains("structure.mass_scaling.step"));
}

TEST_CASE("bad structures get complaints that name the entity and where it is") {
  const auto check = [](const std::string& structure, const std::string& expected) {
    CHECK_THAT(complaint(structure), Catch::Contains(expected));
  };
  check(
      "  parts: {m: {mesh: {nodes: [[0, 0, 0], [1, 0, 0], [5, 5, 5]], segments: [[0, 1]]}, " + cable + "}}\n",
      "(5, 5, 5)");
  check("  parts: {m: {mesh: {nodes: [[0, 0, 0], [0, 0, 0]], segments: [[0, 1]]}, " + cable + "}}\n",
        "segment");
  check("  parts: {m: {mesh: {nodes: [[0, 0, 0], [1, 0, 0]], segments: [[0, 7]]}, " + cable + "}}\n",
        "an element names node 7, but the nodes are numbered 0 to 1");
  check(line + "  supports: [{nodes: rope.beginning, fix: xyz}]\n",
        "there is no node set 'rope.beginning'; known here: rope");
  check(line + "  supports: [{at: [9, 0, 0], fix: xyz}]\n",
        "no node at (9, 0, 0) m; the nearest is node 4 of rope at (4, 0, 0) m, 5 m away");
  check(line + "  supports: [{box: {low: [5, 5, 5], high: [6, 6, 6]}, fix: xyz}]\n",
        "no node between (5, 5, 5) m and (6, 6, 6) m");
  check(line + "  supports: [{nodes: rope, fix: xq}]\n",
        "must be made of the letters x, y and z, but is 'xq'");
  check(line + "  supports: [{nodes: rope, at: [0, 0, 0], fix: x}]\n",
        "needs exactly one of `nodes`, `at` and `box`");
  check(line + "  loads: [{nodes: rope, force: [1, 0, 0], over_time: [[1, 0], [0, 1]]}]\n",
        "needs times that increase");
  check("  parts: {rope: {polyline: {points: [[0, 0, 0]]}, " + cable + "}}\n", "needs at least two points");
  check(
      "  parts: {rope: {polyline: {points: [[0, 0, 0], [1, 0, 0]]}, cable: {area: -1, density: 1, "
      "youngs_modulus: 1}}}\n",
      "structure.parts.rope.cable.area");
  check("  parts: {s: {sheet: {corner: [0, 0, 0], size: [1, 1], element_size: 0.5}, " + cable + "}}\n",
        "a cable needs a shape made of lines");
}

TEST_CASE("the scenes of structures alone can be built and take their first steps") {
  for (const std::string name : {"examples/hanging_net", "examples/hanging_net_implicit",
                                 "examples/loaded_net_static", "hard/snapping_net"}) {
    INFO(name);
    const auto file = core::SceneFile::load(TALUS_SOURCE_DIR "/configs/" + name + ".yaml");
    Structure structure(read_structural_scene(file));
    CHECK(structure.model().nodes() == 121);
    structure.integrator().advance(0, structure.step());
    CHECK(structure.integrator().balance().elastic.size() == 1);
  }
}

TEST_CASE("a run split by a checkpoint in a file is bitwise the run in one piece, for every method") {
  const auto folder = std::filesystem::temp_directory_path() / "talus_fem_checkpoint_test";
  std::filesystem::create_directories(folder);
  const std::string loaded =
      net + "  supports: [{nodes: net.rim, fix: xyz}]\n  loads: [{at: [1, 1, 0], force: [0, 0, -500]}]\n";
  for (const std::string method :
       {"  explicit: {}\n", "  implicit: {}\n  step: 1 ms\n", "  static: {steps: 10}\n"}) {
    const StructuralScene read = scene(loaded + method);
    Structure whole(read), first(read), second(read);
    for (int k = 0; k < 6; ++k) whole.integrator().advance(0.1 * k, 0.1);
    for (int k = 0; k < 3; ++k) first.integrator().advance(0.1 * k, 0.1);
    first.write_checkpoint(folder / "checkpoint.h5");
    second.read_checkpoint(folder / "checkpoint.h5");
    for (int k = 3; k < 6; ++k) second.integrator().advance(0.1 * k, 0.1);
    CHECK(std::ranges::equal(second.integrator().displacement(), whole.integrator().displacement()));
    CHECK(std::ranges::equal(second.integrator().reactions(), whole.integrator().reactions()));
    CHECK(second.integrator().balance().loads == whole.integrator().balance().loads);
  }
  Structure other(scene(net + "  static: {}\n"));
  CHECK_THROWS_WITH(Structure(scene(loaded)).read_checkpoint(folder / "checkpoint.h5"),
                    Catch::Contains("is a checkpoint of 'fem_solver static', not of 'fem_solver explicit'"));
  CHECK_THROWS_WITH(other.read_checkpoint(folder / "checkpoint.h5"),
                    Catch::Contains("it belongs to another scene"));
  std::filesystem::remove_all(folder);
}

TEST_CASE(
    "what ropes with friction, brakes and yielding ropes remember survives checkpoints and going back") {
  const auto folder = std::filesystem::temp_directory_path() / "talus_fem_memory_test";
  std::filesystem::create_directories(folder);
  const std::string section = "area: 1 cm^2, density: 8000, youngs_modulus: 1 GPa";
  const std::string hung =
      "  parts:\n"
      "    rope: {polyline: {points: [[0, 0, 1], [1, 0, 0], [3, 0.5, 1]]}, sliding_cable: {" +
      section +
      ", prestress: 1 MPa, friction: 0.1}}\n"
      "    brake: {polyline: {points: [[1, 0, 0], [1, 0, -1]]}, "
      "brake: {table: [[0.01, 200], [0.5, 400]], mass_per_length: 2}}\n"
      "    stay: {polyline: {points: [[1, 0, 0], [1, 0, 1]]}, elastic_plastic_cable: {" +
      section +
      ", prestress: 1 MPa, yield_stress: 1.05 MPa, hardening: 10 MPa}}\n"
      "  weld: {tolerance: 1 mm}\n"
      "  supports: [{nodes: rope.start, fix: xyz}, {nodes: rope.end, fix: xyz}, {nodes: stay.end, fix: "
      "xyz},\n"
      "             {nodes: brake.end, fix: xy}]\n"
      "  loads: [{nodes: brake.end, force: [0, 0, -350], over_time: [[0, 0], [0.3, 1], [0.5, 0.2]]}]\n";
  const auto advance = [](Structure& structure, int from, int to) {
    for (int k = from; k < to; ++k) structure.integrator().advance(0.1 * k, 0.1);
  };
  for (const std::string method :
       {"  explicit: {}\n", "  implicit: {}\n  step: 1 ms\n", "  static: {steps: 10}\n"}) {
    INFO(method);
    const StructuralScene read = scene(hung + "  damping: {mass: 20 1/s}\n" + method);
    Structure whole(read), first(read), second(read), repeated(read);
    advance(whole, 0, 5);
    advance(first, 0, 3);
    first.write_checkpoint(folder / "checkpoint.h5");
    second.read_checkpoint(folder / "checkpoint.h5");
    advance(second, 3, 5);
    advance(repeated, 0, 3);
    repeated.integrator().save();
    advance(repeated, 3, 5);
    repeated.integrator().restore();
    advance(repeated, 3, 5);
    for (Structure* other : {&second, &repeated}) {
      CHECK(std::ranges::equal(other->integrator().displacement(), whole.integrator().displacement()));
      CHECK(other->integrator().balance().dissipated == whole.integrator().balance().dissipated);
    }
    for (const double joules : whole.integrator().balance().dissipated) CHECK(joules > 0);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("an implicit run needs a step") {
  CHECK_THAT(complaint(line + "  implicit: {}\n"), Catch::Contains("needs `structure.step` or `time.step`"));
}

TEST_CASE("parts that nothing holds are known, with what hangs on them, and slides hold what they lead") {
  const std::string cable = "cable: {area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 10 GPa}";
  const auto line = [&](const char* name, double z) {
    return fmt::format(
        "    {}:\n      polyline: {{points: [[0 m, 0 m, {} m], [1 m, 0 m, {} m]], divisions: 2}}\n      {}\n",
        name, z, z, cable);
  };
  const std::string three = "  parts:\n" + line("held", 0) + line("loose", 0.005) + line("hung", 0.005) +
                            "  supports: [{nodes: held.start, fix: z}]\n";
  const auto unheld = [](const std::string& structure) {
    return talus::fem::unheld_parts(talus::fem::build_model(talus::fem::tests::scene(structure).structure));
  };
  using Lists = std::vector<std::vector<std::string>>;
  CHECK(unheld(three) == Lists{{"loose"}, {"hung"}});
  CHECK(unheld(three + "  weld: {tolerance: 1 mm}\n") == Lists{{"loose", "hung"}});
  CHECK(unheld(three + "  slides: {edge: {rope: held, nodes: loose, penalty: {stiffness: 1 kN/m}}}\n") ==
        Lists{{"hung"}});
  CHECK(unheld(three + "  slides: {edge: {rope: held, nodes: loose, constraint: {}}}\n") == Lists{{"hung"}});
}

TEST_CASE("nodes that constraints lead start on their rope, and not with a leap towards it") {
  const std::string cable =
      "cable: {area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 10 GPa, prestress: 10 MPa}";
  const auto line = [&](const char* name, double z) {
    return fmt::format(
        "    {}:\n      polyline: {{points: [[0 m, 0 m, {} m], [1 m, 0 m, {} m]], divisions: 3}}\n      {}\n",
        name, z, z, cable);
  };
  const std::string two = "  explicit: {}\n  step: 5 us\n  parts:\n" + line("rope", 0) + line("edge", 0.008) +
                          "  supports: [{nodes: rope.start, fix: xyz}, {nodes: rope.end, fix: xyz}]\n";
  const auto velocity_after_a_step = [](const std::string& structure) {
    talus::fem::Structure built(talus::fem::tests::scene(structure));
    built.output();
    built.integrator().advance(0, built.step());
    double most = 0;
    for (const double v : built.integrator().velocity()) most = std::max(most, std::abs(v));
    return most;
  };
  // 8 mm in a step of 5 us were 1600 m/s; along the rope the edge is let go of its prestress: S A/m dt.
  const double let_go = 10e6 * 1e-5 / (0.5 * 7850 * 1e-5 / 3) * 5e-6;
  CHECK(velocity_after_a_step(two + "  slides: {slide: {rope: rope, nodes: edge, constraint: {}}}\n") <
        1.01 * let_go);
  CHECK_THAT(talus::fem::tests::complaint("  parts:\n" + line("rope", 0) + line("edge", 0.02) +
                                          "  slides: {slide: {rope: rope, nodes: edge, constraint: {}}}\n"),
             Catch::Contains("away from the rope, more than 0.01 m"));
  CHECK_THAT(talus::fem::tests::complaint("  parts:\n" + line("rope", 0) + line("other", 0.009) +
                                          line("edge", 0.005) +
                                          "  slides: {a: {rope: rope, nodes: edge, constraint: {}}, b: "
                                          "{rope: other, nodes: edge, constraint: {}}}\n"),
             Catch::Contains("two slides lead it"));
}

TEST_CASE(
    "welding joins the nearest pairs whatever the order of the parts, and never two nodes of one part") {
  // Parts a and b have two nodes each, c one between them; 1 mm joins.
  struct Node {
    char part;
    double x;
  };
  const std::vector<Node> nodes{{'a', 0.0}, {'a', 0.9e-3}, {'c', 0.55e-3}, {'b', 1.3e-3}, {'b', 0.1e-3}};
  const auto partition = [&](std::vector<std::size_t> order) {
    std::vector<double> positions;
    std::vector<talus::fem::Index> parts;
    for (const std::size_t k : order) {
      positions.insert(positions.end(), {nodes[k].x, 0, 0});
      parts.push_back(nodes[k].part - 'a');
    }
    const auto becomes = talus::fem::weld_map(positions, parts, 1e-3);
    std::set<std::set<std::size_t>> groups;
    for (std::size_t i = 0; i < order.size(); ++i) {
      std::set<std::size_t> group;
      for (std::size_t j = 0; j < order.size(); ++j)
        if (becomes[j] == becomes[i]) group.insert(order[j]);
      groups.insert(group);
    }
    return groups;
  };
  // In the order of distance: a0 with b4 (0.1 mm), a1 with c2 (0.35), a1 with b3 (0.4); c2 with b4 (0.45) would make two of a one.
  std::vector<std::size_t> order{0, 1, 2, 3, 4};
  const auto expected = std::set<std::set<std::size_t>>{{0, 4}, {1, 2, 3}};
  do {
    const auto groups = partition(order);
    for (const auto& group : groups) {
      std::set<char> parts;
      for (const std::size_t k : group) CHECK(parts.insert(nodes[k].part).second);
    }
    CHECK(groups == expected);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a set of nodes may not take the name of a part") {
  CHECK_THAT(
      talus::fem::tests::complaint(
          "  parts:\n    rope:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}\n      cable: "
          "{area: 10 mm^2, "
          "density: 7850 kg/m^3, youngs_modulus: 10 GPa}\n  node_sets: {rope: {at: [0 m, 0 m, 0 m]}}\n"),
      Catch::Contains("take another"));
}

TEST_CASE("bars in a chain that nothing holds sideways are refused, and held, taut or braced ones are not") {
  const std::string chain =
      "  parts: {chain: {polyline: {points: [[0, 0, 0], [4, 0, 0]], divisions: 2}, bar: {area: 1 cm^2, "
      "density: 8000, "
      "youngs_modulus: 100 GPa";
  CHECK_THAT(complaint(chain + "}}}\n"),
             Catch::Contains("two bars without prestress meet at node 1 of chain at (2, 0, 0) m"));
  CHECK(complaint(chain + ", prestress: 1 MPa}}}\n") == "no complaint");
  CHECK(complaint(chain + "}}}\n  supports: [{at: [2, 0, 0], fix: y}]\n") == "no complaint");
  CHECK(complaint(chain + "}}, stay: {polyline: {points: [[2, 0, 0], [2, 1, 0]]}, " + cable +
                  "}}\n  weld: {tolerance: 1 mm}\n") == "no complaint");
}

TEST_CASE("a rope's own ends are welded to what is there, as its scene welds") {
  const std::string parts =
      "  parts:\n    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1}, " + cable +
      "}\n    post: {polyline: {points: [[-1, 0, 0], [-1, 0, 2]]}, " + cable +
      "}\n    rope: {through: {nodes: [net.edge_south], from: [-1.0005, 0, 0], to: [4, 0, 0]}, " + cable +
      "}\n";
  const Structure apart(scene(parts)), welded(scene(parts + "  weld: {tolerance: 1 mm}\n"));
  CHECK(apart.model().nodes() == 16 + 2 + 2);
  CHECK(welded.model().nodes() == 16 + 2 + 1);
  CHECK(welded.model().node_sets.at("rope.start") == welded.model().node_sets.at("post.start"));
}
