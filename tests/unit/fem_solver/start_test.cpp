#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/fem_solver/structural_scenes.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::fem::tests;

constexpr double g = 9.81;
const std::string newton = "  start: {equilibrium: {}}\n",
                  falling = "  start: {relaxation: {tolerance: 1e-9}}\n";
const std::string by_leapfrog = "  explicit: {}\n  step: 20 us\n",
                  by_newmark = "  implicit: {}\n  step: 1 ms\n";

/// A structure under its weight, and the ways to its equilibrium that lead there.
struct Kind {
  const char* name;
  std::string structure;
  std::vector<std::string> starts = {newton, falling};
};

const std::string steel = "area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 10 GPa";
const std::string hung = "  gravity: [0, 0, -9.81]\n  weld: {tolerance: 1 mm}\n";

std::vector<Kind> kinds() {
  const std::string
      rope = "polyline: {points: [[-1 m, 0 m, 2 m], [0 m, 0 m, 0 m], [2 m, 0 m, 2 m]]}",
      weight = "  point_masses:\n    - {at: [0 m, 0 m, 0 m], mass: 100 kg}\n",
      ends = "  supports:\n    - {nodes: rope.start, fix: xyz}\n    - {nodes: rope.end, fix: xyz}\n";
  const std::string sheet =
      "  parts:\n    sheet:\n      sheet: {corner: [0 m, 0 m, 0 m], size: [2 m, 2 m], element_size: 0.5 m}\n"
      "      membrane: {thickness: 1 mm, density: 1500 kg/m^3, isotropic: {youngs_modulus: 10 MPa, "
      "poissons_ratio: "
      "0.3}";
  const std::string edges =
      "  supports:\n    - {nodes: sheet.edge_north, fix: xyz}\n    - {nodes: sheet.edge_south, "
      "fix: xyz}\n";
  const std::string curtain =
      "  parts:\n    net:\n      square_net: {corner: [0 m, 0 m, 0 m], size: [1.2 m, 0.8 m], across: [0, 0, "
      "1], pitch: "
      "0.2 m, rim: open}\n      cable: {" +
      steel +
      "}\n    upper:\n      polyline: {points: [[0 m, 0 m, 0.8 m], [1.2 m, 0 m, 0.8 m]], divisions: 7}\n     "
      " cable: "
      "{" +
      steel +
      ", prestress: 50 MPa}\n  supports:\n    - {nodes: upper.start, fix: xyz}\n    - {nodes: upper.end, "
      "fix: xyz}\n";
  return {
      {"a taut net",
       "  parts:\n    net:\n      square_net: {corner: [0 m, 0 m, 0 m], size: [2 m, 2 m], pitch: 0.5 m}\n    "
       "  cable: {" +
           steel + ", prestress: 1 MPa}\n  supports:\n    - {nodes: net.rim, fix: xyz}\n"},
      {"a slack net",
       "  parts:\n    net:\n      square_net: {corner: [0 m, 0 m, 0 m], size: [2 m, 2 m], pitch: 0.5 m}\n    "
       "  cable: {" +
           steel + "}\n  supports:\n    - {nodes: net.corners, fix: xyz}\n"},
      {"a rope that runs freely",
       "  parts:\n    rope:\n      " + rope + "\n      sliding_cable: {" + steel + "}\n" + weight + ends,
       {falling}},
      {"a rope with friction",
       "  parts:\n    rope:\n      " + rope + "\n      sliding_cable: {" + steel + ", friction: 0.1}\n" +
           weight + ends,
       {falling}},
      {"a rope that yields", "  parts:\n    rope:\n      " + rope + "\n      elastic_plastic_cable: {" +
                                 steel + ", yield_stress: 60 MPa, hardening: 1 GPa}\n" + weight + ends},
      {"a brake that runs", "  parts:\n    rope:\n      " + rope +
                                "\n      brake: {table: [[5 mm, 300 N], [0.4 m, 2 kN]], mass_per_length: 1 "
                                "kg/m}\n" +
                                weight + ends},
      {"a sheet", sheet + "}\n" + edges, {falling}},
      {"a sheet that wrinkles", sheet + ", tension_field: {}}\n" + edges, {falling}},
      {"sliders on springs",
       curtain +
           "  slides:\n    edge: {rope: upper, nodes: net.edge_north, penalty: {stiffness: 100 kN/m}}\n",
       {"  start: {relaxation: {}}\n"}},  // sliders go from one segment of the rope to the next and back
  };
}

double most(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

TEST_CASE("a structure that starts at rest under its weight stays there, whatever it is and however it moves",
          "[long]") {
  for (const Kind& kind : kinds())
    for (const std::string& start : kind.starts)
      for (const std::string& method : {by_leapfrog, by_newmark}) {
        CAPTURE(kind.name, start, method);
        Structure built(tests::scene(kind.structure + hung + start + method));
        const std::vector<double> at_first = built.start().displacement;
        REQUIRE(most(at_first) > 1e-4);  // the weight has moved it
        const double step = built.step(), end = 0.02;
        for (double time = 0; time < end - 0.5 * step; time += step) built.integrator().advance(time, step);
        std::vector<double> moved(at_first.size());
        for (std::size_t i = 0; i < moved.size(); ++i)
          moved[i] = built.integrator().displacement()[i] - at_first[i];
        CHECK(most(moved) < 1e-2 * 0.5 * g * end * end);
      }
}

TEST_CASE("each element of a chain that starts at rest bears what hangs below it") {
  // Elements of 0.0785 kg, half at each node: element e of four from the top has 4 - e - 1/2 of them below.
  const std::string chain =
      "  gravity: [0, 0, -9.81]\n  parts:\n    chain:\n      polyline: {points: [[0 m, 0 m, 4 m], [0 m, 0 m, "
      "0 m]], "
      "divisions: 4}\n      cable: {" +
      steel + "}\n  supports:\n    - {nodes: chain.start, fix: xyz}\n";
  for (const std::string& start : {newton, falling}) {
    CAPTURE(start);
    const Structure built(tests::scene(chain + start));
    const auto& cable = std::get<CableBatch>(built.model().parts[0].elements);
    for (Index e = 0; e < 4; ++e)
      CHECK(cable.axial_force(built.start().displacement, e) == Approx(0.0785 * g * (3.5 - e)).epsilon(1e-6));
  }
}

TEST_CASE("a load and a moved support are at the start what their tables say of time 0") {
  const std::string bar =
      "  parts:\n    bar:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}\n      bar: {" +
      steel +
      "}\n  supports:\n    - {nodes: bar.start, fix: xyz, displacement: [0.1 m, 0 m, 0 m], over_time: [[0 s, "
      "0.5], [1 s, 1]]}\n"
      "    - {nodes: bar.end, fix: yz}\n  loads:\n    - {nodes: bar.end, force: [2 N, 0 N, 0 N], over_time: "
      "[[0 s, 0.25], [1 s, 1]]}\n";
  for (const std::string& start : {newton, falling}) {
    CAPTURE(start);
    const Structure built(tests::scene(bar + start));
    CHECK(built.start().displacement[0] == Approx(0.05).epsilon(1e-12));
    // 0.5 N on E A = 1e5 N: strains of 5e-6, so the change of shape does not count.
    CHECK(built.start().displacement[3] - 0.05 == Approx(0.5 / 1e5).epsilon(2e-5));
  }
}

TEST_CASE("what cannot come to rest is an error that names a node") {
  const std::string loose =
      "  gravity: [0, 0, -9.81]\n  parts:\n    rope:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, "
      "0 m]]}\n      "
      "cable: {" +
      steel + "}\n";
  for (const std::string& start : {newton, std::string("  start: {relaxation: {steps: 500}}\n")}) {
    CAPTURE(start);
    CHECK_THROWS_WITH(Structure(tests::scene(loose + start)), Catch::Contains("of rope at"));
  }
}

TEST_CASE("a start at rest is refused where it has no meaning, or no way") {
  const std::string rope =
      "  parts:\n    rope:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]], divisions: 4}\n     "
      " cable: {" +
      steel +
      "}\n    other:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]], divisions: 3}\n      "
      "cable: {" +
      steel + "}\n";
  CHECK_THAT(tests::complaint(rope + newton + "  static: {}\n"), Catch::Contains("finds the equilibrium"));
  CHECK_THAT(
      tests::complaint(rope + falling + "  slides:\n    edge: {rope: rope, nodes: other, constraint: {}}\n"),
      Catch::Contains("knows no `slides` with `constraint`"));
}

namespace {

/// Runs a structure to a time and says what became of it.
struct Run {
  explicit Run(const std::string& structure) : built(tests::scene(structure)) { built.output(); }
  void advance_to(double end) {
    const double step = built.step();
    for (; time < end - 0.5 * step; time += step) built.integrator().advance(time, step);
  }
  double displacement(Index direction) const { return built.integrator().displacement()[direction]; }
  Structure built;
  double time = 0;
};

const std::string weighted_bar =
    "  parts:\n    bar:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}\n      bar: {" + steel +
    "}\n  point_masses:\n    - {nodes: bar.end, mass: 10 kg}\n  supports:\n    - {nodes: bar.start, fix: "
    "xyz}\n    - "
    "{nodes: bar.end, fix: yz}\n";

}  // namespace

TEST_CASE("a mass let go from a displacement swings with its amplitude, by each method") {
  // E A/L = 1e5 N/m on 10 kg and half the bar: after half a period it is on the other side.
  const double mass = 10 + 0.5 * 7850 * 1e-5, period = 2 * 3.14159265358979 * std::sqrt(mass / 1e5);
  for (const char* method :
       {"  explicit: {}\n  step: 10 us\n", "  implicit: {spectral_radius: 1}\n  step: 100 us\n"}) {
    Run run(weighted_bar +
            "  initial_displacements:\n    - {nodes: bar.end, displacement: [10 um, 0 m, 0 m]}\n" + method);
    CHECK(run.displacement(3) == 1e-5);
    run.advance_to(0.5 * period);
    CHECK(run.displacement(3) == Approx(-1e-5).epsilon(1e-3));
  }
}

TEST_CASE(
    "a support with a velocity moves steadily from time 0 on, and its work becomes the motion of what it "
    "pulls") {
  for (const char* method :
       {"  explicit: {}\n  step: 10 us\n", "  implicit: {spectral_radius: 1}\n  step: 100 us\n"}) {
    std::string moved = weighted_bar;
    moved.replace(moved.find("nodes: bar.start, fix: xyz"), 26,
                  "nodes: bar.start, fix: xyz, velocity: [0.5, 0, 0]");
    Run run(moved + method);
    run.advance_to(0.1);
    CHECK(run.displacement(0) == Approx(0.05).epsilon(1e-9));
    const EnergyBalance balance = run.built.integrator().balance();
    CHECK(balance.kinetic + balance.elastic[0] == Approx(balance.supports).epsilon(5e-3));
    CHECK(balance.supports > 0.1);
  }
}

TEST_CASE("a sliding rope and a brake that break let their weight fall, and what they stored is dissipated") {
  const std::string pulley =
      "  gravity: [0, 0, -9.81]\n  parts:\n    rope:\n      polyline: {points: [[-1 m, 0 m, 2 m], [0 m, 0 m, "
      "0 m], [2 m, 0 m, 2 m]]}\n"
      "      ELEMENT\n  point_masses:\n    - {at: [0 m, 0 m, 0 m], mass: 100 kg}\n  supports:\n    - {nodes: "
      "rope.start, "
      "fix: xyz}\n    - {nodes: rope.end, fix: xyz}\n";
  for (const std::string& element : {"sliding_cable: {" + steel + ", breaks: {force: 500 N}}",
                                     "sliding_cable: {" + steel + ", friction: 0.2, breaks: {force: 500 N}}",
                                     std::string("brake: {table: [[5 mm, 300 N], [0.4 m, 2 kN]], "
                                                 "mass_per_length: 1 kg/m, breaks: {force: 500 N}}")})
    for (const char* method : {"  explicit: {}\n  step: 20 us\n", "  implicit: {}\n  step: 0.5 ms\n"}) {
      CAPTURE(element, method);
      std::string structure = pulley;
      Run run(structure.replace(structure.find("ELEMENT"), 7, element) + method);
      run.advance_to(0.5);
      const EnergyBalance balance = run.built.integrator().balance();
      CHECK(balance.dissipated[0] > 0);
      CHECK(balance.elastic[0] == 0);
      const double total = balance.kinetic + balance.elastic[0] + balance.dissipated[0] + balance.gravity;
      CHECK(std::abs(total) < 2e-3 * balance.kinetic);
      CHECK(run.displacement(5) < -0.6);  // of the 1.23 m of a free fall
    }
}

TEST_CASE("gravity that comes on over time does the work of its present strength, by every method") {
  // A weight on a soft spring falls under g t/T: nearly free, so it has fallen by g t^3/(6 T).
  const std::string soft =
      "  gravity: [10, 0, 0]\n  gravity_over_time: [[0 s, 0], [1 s, 1]]\n  parts:\n    bar:\n      polyline: "
      "{points: [[0 m, 0 m, 0 m], "
      "[1 m, 0 m, 0 m]]}\n      bar: {area: 1 mm^2, density: 7850 kg/m^3, youngs_modulus: 1 MPa}\n  "
      "point_masses:\n    - {nodes: "
      "bar.end, mass: 10 kg}\n  supports:\n    - {nodes: bar.start, fix: xyz}\n    - {nodes: bar.end, fix: "
      "yz}\n";
  for (const char* method :
       {"  explicit: {}\n  step: 100 us\n", "  implicit: {spectral_radius: 1}\n  step: 1 ms\n"}) {
    CAPTURE(method);
    Run run(soft + method);
    run.advance_to(0.3);
    const double fall = 10 * 0.027 / 6;
    CHECK(run.displacement(3) == Approx(fall).epsilon(5e-3));
    const EnergyBalance balance = run.built.integrator().balance();
    CHECK(balance.kinetic + balance.elastic[0] + balance.gravity == Approx(0).margin(1e-3 * balance.kinetic));
    // m (g t^2/2T)^2/2
    CHECK(-balance.gravity == Approx(0.5 * 10 * 0.45 * 0.45).epsilon(2e-2));
  }
  Run at_rest(soft + "  static: {steps: 10}\n");
  at_rest.advance_to(
      0.5);  // half of the weight of 100 N on E A = 1 N m/m, St. Venant's law: E A e (1 + e)(1 + e/2) = 50 N
  const double e = at_rest.displacement(3);
  CHECK(e * (1 + e) * (1 + 0.5 * e) == Approx(0.5 * 10 * (10 + 0.5 * 7850e-6)).epsilon(1e-6));
  CHECK_THAT(tests::complaint("  gravity_over_time: [[0 s, 0], [1 s, 1]]\n" + weighted_bar),
             Catch::Contains("needs `gravity` beside it"));
}
