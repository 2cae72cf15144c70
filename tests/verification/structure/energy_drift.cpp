#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/scene/reader.hpp"
#include "fem_solver/app/structure.hpp"
#include "fem_solver/integration/explicit.hpp"

// Explicit, undamped, elastic: at 0.9 of the limit the total energy stays within 0.1 % of the largest kinetic
// energy over 1e5 steps. Prestress keeps everything taut: cables that go slack and snap taut need smaller
// steps (configs/hard/snapping_net.yaml). Ropes are heavy and stiff, so that the start is near equilibrium.
namespace {

using namespace talus;
using namespace talus::fem;

const std::string sides[] = {"south", "east", "north", "west"};
const std::string corners[] = {"[0, 0, 0]", "[1, 0, 0]", "[1, 1, 0]", "[0, 1, 0]"};

/// A panel of 1 m on four sliding edge ropes that are anchored at its corners. @param rope_ends of an open
/// net, which has no corner nodes
std::string on_sliding_ropes(const std::string& panel, bool rope_ends) {
  std::string parts = "  parts:\n    panel: {" + panel + "}\n", supports = "  supports:\n";
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string ends = rope_ends ? ", from: " + corners[k] + ", to: " + corners[(k + 1) % 4] : "";
    parts += "    " + sides[k] + ": {through: {nodes: [panel.edge_" + sides[k] + "]" + ends +
             "}, sliding_cable: {area: 10 cm^2, density: 8000, youngs_modulus: 10 GPa, prestress: 1 GPa}}\n";
    supports +=
        "    - {nodes: " + sides[k] + ".start, fix: xyz}\n    - {nodes: " + sides[k] + ".end, fix: xyz}\n";
  }
  return parts + supports;
}

std::unique_ptr<Structure> built(const std::string& structure, double step) {
  return std::make_unique<Structure>(read_structural_scene(core::SceneFile::parse(
      "time: {end: 1 s}\nstructure:\n" + structure + "  step: " + std::to_string(step) + "\n",
      "scene.yaml")));
}

double total(const EnergyBalance& balance) {
  double sum = balance.kinetic;
  for (const double elastic : balance.elastic) sum += elastic;
  return sum;
}

/// Largest change of the total over the largest kinetic energy, after a wide push across the panel at `speed`
/// (m/s).
double drift(const std::string& structure, double speed) {
  const double limit = built(structure, 1e-6)->bounds().front().seconds, step = 0.9 * limit;
  const auto run = built(structure, step);
  auto& solver = dynamic_cast<ExplicitSolver&>(run->integrator());
  for (Index node = 0; node < run->model().nodes(); ++node) {
    const Vector3 x = run->model().position(node) * std::numbers::pi;
    solver.state().velocity[3 * static_cast<std::size_t>(node) + 2] =
        speed * std::max(0.0, std::sin(x.x()) * std::sin(x.y()));
  }
  const double start = total(solver.balance());
  double largest_kinetic = 0, worst = 0;
  for (int k = 0; k < 1000; ++k) {
    for (int n = 0; n < 100; ++n) solver.step((100 * k + n) * step, step);
    const EnergyBalance balance = solver.balance();
    largest_kinetic = std::max(largest_kinetic, balance.kinetic);
    worst = std::max(worst, std::abs(total(balance) - start));
  }
  return worst / largest_kinetic;
}

constexpr double allowed = 1e-3;

}  // namespace

TEST_CASE("a net on sliding edge ropes keeps its energy over 1e5 steps at 0.9 of the limit") {
  CHECK(drift(on_sliding_ropes(
                  "square_net: {corner: [0, 0, 0], size: [1, 1], pitch: 0.2, rim: open}, "
                  "cable: {area: 10 mm^2, density: 8000, youngs_modulus: 1 GPa, prestress: 50 MPa}",
                  true),
              2) < allowed);
}

TEST_CASE("a membrane with a tension field keeps its energy over 1e5 steps at 0.9 of the limit") {
  const std::string panel =
      "sheet: {corner: [0, 0, 0], size: [1, 1], element_size: 0.2}, "
      "membrane: {thickness: 1 mm, density: 1000, isotropic: {youngs_modulus: 100 MPa, poissons_ratio: 0.3}, "
      "prestress: {xx: 5 MPa, yy: 5 MPa}, tension_field: {}}";
  CHECK(drift("  parts: {panel: {" + panel + "}}\n  supports: [{nodes: panel.rim, fix: xyz}]\n", 3) <
        allowed);
}
