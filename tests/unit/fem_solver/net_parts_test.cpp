// Nets as parts: twists of two wires, panels of rings, nodes alone.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

#include "fem_solver/app/structure.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

namespace {

using namespace talus;
using namespace talus::fem;
using tests::complaint;
using tests::scene;

const std::string double_twist =
    "hexagonal_net: {corner: [0, 0, 0], size: [0.8, 0.7], mesh_size: [80 mm, 100 mm], twist_length: 40 mm, "
    "wire_diameter: 2.7 mm}";
const std::string wire = "area: 5 mm^2, density: 8000, youngs_modulus: 100 GPa";

std::string part(const std::string& keys) {
  return "  parts: {net: {" + keys + "}}\n";
}

double total_mass(const Model& model) {
  return std::accumulate(model.node_masses.begin(), model.node_masses.end(), 0.0);
}

double length_of(const Part& part, const Model& model) {
  double sum = 0;
  for (const auto& [a, b] : std::get<CableBatch>(part.elements).cells())
    sum += (model.position(b) - model.position(a)).norm();
  return sum;
}

double reaction(Structure& structure, std::size_t direction) {
  double sum = 0;
  const auto reactions = structure.integrator().reactions();
  for (std::size_t i = direction; i < reactions.size(); i += 3) sum += reactions[i];
  return sum;
}

}  // namespace

TEST_CASE(
    "a double-twist net of one entry has single wires, and twists with twice their area, mass and "
    "thickness") {
  const Structure structure(scene(part(double_twist + ", cable: {" + wire + ", breaking_load: 2 kN}")));
  const Model& model = structure.model();
  REQUIRE(model.parts.size() == 2);
  const Part &single = model.parts[0], &twist = model.parts[1];
  CHECK(single.name == "net");
  CHECK(twist.name == "net.twist");
  CHECK(std::get<CableBatch>(single.elements).part().section.area == Approx(5e-6));
  CHECK(std::get<CableBatch>(twist.elements).part().section.area == Approx(10e-6));
  CHECK(single.breaking_load == 2000);
  CHECK(twist.breaking_load == 4000);
  CHECK(single.wire_radius == Approx(1.35e-3));
  CHECK(twist.wire_radius == Approx(2.7e-3));
  // 5 rows of openings of 10 twists each, 40 mm long, the rows 70 mm apart; at the lower rim begins a row of them.
  for (Index e = 0; e < std::get<CableBatch>(twist.elements).size(); ++e)
    CHECK(std::get<CableBatch>(twist.elements).reference_length(e) <= 0.0401);
  CHECK(total_mass(model) ==
        Approx(8000 * 5e-6 * (length_of(single, model) + 2 * length_of(twist, model))).epsilon(1e-12));
  // Of the wire in whole openings 2 x 40 mm of 180 mm are in twists.
  CHECK(2 * length_of(twist, model) / (length_of(single, model) + 2 * length_of(twist, model)) ==
        Approx(80. / 180).epsilon(0.1));
}

TEST_CASE("gravity and damping of a double-twist part are those of its twists too") {
  const Structure structure(
      scene(part(double_twist + ", cable: {" + wire + "}, gravity: [0, 0, -2], damping: {stiffness: 1 us}")));
  double weight = 0;
  for (std::size_t i = 2; i < structure.model().weight.size(); i += 3) weight += structure.model().weight[i];
  CHECK(weight == Approx(-2 * total_mass(structure.model())));
  for (const Part& part : structure.model().parts) CHECK(part.stiffness_damping == 1e-6);
}

TEST_CASE("a panel of rings is one entry, and weighs what its windings weigh") {
  const Structure structure(
      scene(part("ring_net: {corner: [0, 0, 0], size: [1.5, 1.2], inner_diameter: 300 mm, wire_diameter: 3 "
                 "mm, windings: 12}, "
                 "ring: {density: 8000}")));
  const Model& model = structure.model();
  REQUIRE(model.parts.size() == 1);
  const auto& rings = std::get<PlainRingBatch>(model.parts[0].elements);
  CHECK(rings.size() == 20);
  // The bundle of 12 wires, packed as densely as circles can be, is 3 mm sqrt(12 sqrt(12)/pi) thick.
  const double pi = std::numbers::pi, bundle = 0.003 * std::sqrt(12 * std::sqrt(12.0) / pi);
  CHECK(total_mass(model) ==
        Approx(20 * 12 * 8000 * pi / 4 * 0.003 * 0.003 * pi * (0.3 + bundle)).epsilon(1e-12));
  CHECK(model.parts[0].wire_radius == Approx(bundle / 2));
  CHECK(model.parts[0].breaking_load ==
        Approx(0.5 * 12 * (80.55e3 / 9 + 4. / 7 * (177.66e3 / 16 - 80.55e3 / 9))));
  CHECK(model.node_sets.at("net.rim").size() == 18);
  CHECK(model.node_sets.at("net.edge_west").size() == 4);
}

TEST_CASE(
    "a chain of rings is led apart by statics to the force of its law, and unloads along the stretch of its "
    "wire") {
  const auto chain = [](double pull) {
    Structure built(scene(part("mesh: {nodes: [[0, 0, 0], [0.3, 0, 0], [0.6, 0, 0], [0.9, 0, 0]], "
                               "segments: [[0, 1], [1, 0], [1, 2], [2, 1], [2, 3], [3, 2]]}, "
                               "ring: {windings: 9, wire_diameter: 3 mm, inner_diameter: 0.3 m}") +
                          "  static: {steps: 10}\n"
                          "  supports: [{nodes: net.0, fix: xyz}, {nodes: net.3, fix: xyz, displacement: [" +
                          std::to_string(pull) + ", 0, 0], over_time: [[0, 0], [0.8, 1], [1, 0.999]]}]\n"));
    for (int k = 0; k < 8; ++k) built.integrator().advance(0.1 * k, 0.1);
    const double loaded = built.integrator().reactions()[3];
    for (int k = 8; k < 10; ++k) built.integrator().advance(0.1 * k, 0.1);
    return std::pair(loaded, built.integrator().reactions()[3]);
  };
  const auto [bending, released] = chain(0.2082);  // half of 85 % of 490 mm
  CHECK(bending == Approx(0.5 * 0.15 * 80.55e3).epsilon(1e-3));
  const auto [stretching, less] = chain(0.49);
  CHECK(stretching == Approx(80.55e3).epsilon(1e-6));
  // 0.1 % of the elongation is taken back; 0.4 % of a perimeter of 2 (0.3 m + 0.49 m/3) would make it slack.
  CHECK(less == Approx(80.55e3 * (1 - 2 * 0.49e-3 / 3 / (0.004 * 2 * (0.3 + 0.49 / 3)))).epsilon(1e-6));
  CHECK(released < bending);
}

TEST_CASE("a panel of rings under a load hangs alike by statics, slowly through time, and implicitly") {
  const auto panel = [](const std::string& method) {
    return part(
               "ring_net: {corner: [0, 0, 0], size: [0.9, 0.9], inner_diameter: 300 mm, wire_diameter: 3 mm, "
               "windings: 7}, ring: {}") +
           "  supports: [{nodes: net.rim, fix: xyz}]\n"
           "  loads: [{at: [0.45, 0.3, 0], force: [0, 0, -8000], over_time: [[0, 0], [1, 1]]},\n"
           "          {at: [0.45, 0.6, 0], force: [0, 0, -8000], over_time: [[0, 0], [1, 1]]}]\n" +
           method;
  };
  const auto deepest = [](Structure& structure) {
    double z = 0;
    for (std::size_t i = 2; i < structure.integrator().displacement().size(); i += 3)
      z = std::min(z, structure.integrator().displacement()[i]);
    return z;
  };
  Structure statically(scene(panel("  static: {steps: 20}\n")));
  for (int k = 0; k < 20; ++k) statically.integrator().advance(0.05 * k, 0.05);
  CHECK(reaction(statically, 2) == Approx(16000).epsilon(1e-6));
  Structure slowly(scene(panel("  damping: {mass: 100 1/s}\n")));
  slowly.integrator().advance(0, 1);
  Structure implicitly(scene(panel("  damping: {mass: 100 1/s}\n  implicit: {}\n  step: 1 ms\n")));
  for (int k = 0; k < 10; ++k) implicitly.integrator().advance(0.1 * k, 0.1);
  CHECK(deepest(statically) < -0.1);
  CHECK(deepest(slowly) == Approx(deepest(statically)).epsilon(0.02));
  CHECK(deepest(implicitly) == Approx(deepest(slowly)).epsilon(0.005));
}

TEST_CASE("a rope runs through a part that is nothing but nodes") {
  const std::string posts = "  parts:\n    heads: {nodes: {at: [[0, 0, 0], [1, 0, 0.2], [2, 0, 0]]}}\n";
  const Structure structure(scene(posts + "    rope: {through: {nodes: [heads]}, cable: {" + wire + "}}\n"));
  CHECK(structure.model().nodes() == 3);
  REQUIRE(structure.model().parts.size() == 1);
  CHECK(total_mass(structure.model()) == Approx(8000 * 5e-6 * 2 * std::hypot(1, 0.2)));
  CHECK(structure.model().node_sets.at("heads.1") == std::vector<Index>{1});
  CHECK_THAT(complaint(posts), Catch::Contains("no element is connected to node"));
}

TEST_CASE("nets that their elements do not fit are refused with the reason") {
  const auto check = [](const std::string& keys, const std::string& expected) {
    CHECK_THAT(complaint(part(keys)), Catch::Contains(expected));
  };
  const std::string rings =
      "ring_net: {corner: [0, 0, 0], size: [1.5, 1.2], inner_diameter: 300 mm, "
      "wire_diameter: 3 mm, windings: 7}";
  const std::string chain = "mesh: {nodes: [[0, 0, 0], [0.3, 0, 0]], segments: [[0, 1], [1, 0]]}";
  check(rings + ", ring: {windings: 7}", "net.ring: has its windings and diameters from `ring_net`");
  check(chain + ", ring: {windings: 7}", "needs `windings`, `wire_diameter` and `inner_diameter`");
  check(
      "ring_net: {corner: [0, 0, 0], size: [1.6, 1.2], inner_diameter: 300 mm, wire_diameter: 3 mm, "
      "windings: 7}, "
      "ring: {}",
      "would stand 6.67 % too far apart or too near");
  check(
      "polyline: {points: [[0, 0, 0], [1, 0, 0]]}, ring: {windings: 7, wire_diameter: 3 mm, inner_diameter: "
      "0.3 m}",
      "a ring is a closed line");
  check(double_twist + ", brake: {table: [[0.1, 100]], mass_per_length: 1}",
        "has twists of two wires and needs an element with `area`");
  check("nodes: {at: [[0, 0, 0]]}, cable: {" + wire + "}", "cable");
}
