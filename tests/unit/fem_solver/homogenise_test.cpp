#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/errors.hpp"
#include "fem_solver/homogenise/fit.hpp"
#include "fem_solver/scene/homogenise_scene.hpp"
#include "interface_mesh/net_patterns.hpp"

using namespace talus;
using fem::PlaneStrain;

namespace {

constexpr double EA = 2e6, area = 1e-5, pitch = 0.2;  // N, m^2, m

fem::AxialSection cable(double prestress = 0) {
  return {.area = area, .youngs_modulus = EA / area, .prestress = prestress};
}

fem::PeriodicNet square(double prestress = 0) {
  return fem::periodic_net(lattice(mesh::SquarePattern{.pitch = pitch}), cable(prestress), 7850);
}

fem::PeriodicNet hexagonal() {
  return fem::periodic_net(lattice(mesh::HexagonalPattern{
                               .mesh_size = {0.08, 0.1}, .twist_length = 0.04, .wire_diameter = 0.0027}),
                           cable(), 7850);
}

}  // namespace

TEST_CASE(
    "a square net is the sheet of stiffness EA/pitch along both axes, without contraction, and nothing is "
    "missed but G") {
  const double thickness = 0.002, prestress = 3e7;
  const auto sheet = fem::fit_sheet(square(prestress), {.strain = 0.05, .thickness = thickness});
  CHECK(sheet.moduli.youngs_modulus_x == Approx(EA / (pitch * thickness)).epsilon(1e-9));
  CHECK(sheet.moduli.youngs_modulus_y == Approx(EA / (pitch * thickness)).epsilon(1e-9));
  CHECK(std::abs(sheet.moduli.poissons_ratio_xy) < 1e-9);
  CHECK(sheet.prestress.xx == Approx(prestress * area / (pitch * thickness)).epsilon(1e-12));
  CHECK(std::abs(sheet.prestress.xy) < 1e-6);
  // Two wires of one pitch in a cell of one pitch squared.
  CHECK(sheet.density == Approx(7850 * area * 2 / (pitch * thickness)).epsilon(1e-12));
  REQUIRE(sheet.remarks.size() == 1);
  CHECK(sheet.remarks[0].find("hardly resists shear") != std::string::npos);
  CHECK(sheet.error < 1e-3);
}

TEST_CASE("a chain-link net has the stiffness of its wires' directions: sums of EA n n n n") {
  const double x = 0.08, y = 0.14, side = std::hypot(x, y) / 2, s = x / 2 / side, c = y / 2 / side;
  const auto net = fem::periodic_net(
      lattice(mesh::RhombicPattern{.diagonals = {x, y}, .wire_diameter = 0.003}), cable(), 7850);
  const double scale = EA * 4 * side / (x * y);
  fem::NetResponse response(net);
  // No node leaves the uniform motion: each is a centre of symmetry. Then e = n.E n in every wire.
  response.stretch_to({0.01, 0.004, 0.003});
  const auto force = response.membrane_force();
  CHECK(force.xx == Approx(scale * (s * s * s * s * 0.01 + s * s * c * c * 0.004)).epsilon(1e-9));
  CHECK(force.yy == Approx(scale * (s * s * c * c * 0.01 + c * c * c * c * 0.004)).epsilon(1e-9));
  CHECK(force.xy == Approx(scale * s * s * c * c * 0.003).epsilon(1e-9));

  const auto sheet = fem::fit_sheet(net, {.strain = 0.02, .thickness = 1});
  CHECK(sheet.moduli.shear_modulus == Approx(scale * s * s * c * c).epsilon(1e-6));
  REQUIRE(sheet.remarks.size() == 1);
  CHECK(sheet.remarks[0].find("the net is a mechanism: C12 is 1 of") == 0);
  // What the mechanism is given: a thousandth of the stiffness across it, C11 = scale s^4 and C22 = scale
  // c^4.
  CHECK(sheet.moduli.youngs_modulus_x == Approx(1e-3 * scale * s * s * s * s).epsilon(1e-3));
  CHECK(sheet.moduli.youngs_modulus_y == Approx(1e-3 * scale * c * c * c * c).epsilon(1e-3));
}

TEST_CASE("the membrane force of a net is the derivative of its energy") {
  const auto net = hexagonal();
  const double step = 1e-6;
  for (const PlaneStrain<double> at :
       {PlaneStrain<double>{0.05, 0.05, 0}, {0.06, 0.04, 0.02}, {0.03, 0.05, -0.015}}) {
    fem::NetResponse response(net);
    response.stretch_to(at);
    const auto force = response.membrane_force();
    const auto slope = [&](PlaneStrain<double> more, PlaneStrain<double> less) {
      response.stretch_to(more);
      const double upper = response.energy_per_area();
      response.stretch_to(less);
      return (upper - response.energy_per_area()) / (2 * step);
    };
    const double scale = std::abs(force.xx) + std::abs(force.yy);
    // Central differences: truncation of order step^2, round-off of order 1e-16/step relative to the energy.
    CHECK(
        force.xx ==
        Approx(slope({at.xx + step, at.yy, at.shear}, {at.xx - step, at.yy, at.shear})).margin(1e-5 * scale));
    CHECK(
        force.yy ==
        Approx(slope({at.xx, at.yy + step, at.shear}, {at.xx, at.yy - step, at.shear})).margin(1e-5 * scale));
    CHECK(
        force.xy ==
        Approx(slope({at.xx, at.yy, at.shear + step}, {at.xx, at.yy, at.shear - step})).margin(1e-5 * scale));
  }
}

TEST_CASE("no shift of a node lowers the energy of a stretched double-twist net") {
  const auto net = hexagonal();
  fem::NetResponse response(net);
  response.stretch_to({0.05, 0.05, 0.01});
  const Eigen::VectorXd& at_rest = response.fluctuations();
  REQUIRE(at_rest.norm() > 1e-4);  // m; the nodes do leave the uniform motion
  // A force of 2 N left over (of 1e5 N in the wires) lowers the energy on one way of 1e-7 m or the other: 2e-7 J
  // against the 2e-7 J that 4e7 N/m of stiffness take, and 1e-13 J of round-off.
  constexpr double way = 1e-7;
  std::srand(23);
  for (Eigen::Index k = 0; k < at_rest.size() + 50; ++k) {
    Eigen::VectorXd shift = Eigen::VectorXd::Random(at_rest.size());
    if (k < at_rest.size()) shift = Eigen::VectorXd::Unit(at_rest.size(), k);  // one node along one axis
    shift *= way / shift.norm();
    CHECK(response.energy_per_area(at_rest + shift) > response.energy_per_area());
    CHECK(response.energy_per_area(at_rest - shift) > response.energy_per_area());
  }
}

TEST_CASE("a stretched double-twist net has the same energy whether it got there in one step or in ten") {
  const auto net = hexagonal();
  fem::NetResponse response(net);
  response.stretch_to({0.05, 0.05, 0.01});
  fem::NetResponse in_steps(net);
  for (int k = 1; k <= 10; ++k) in_steps.stretch_to({0.005 * k, 0.005 * k, 0.001 * k});
  CHECK(in_steps.energy_per_area() == Approx(response.energy_per_area()).epsilon(1e-10));
}

TEST_CASE(
    "the twists of a double-twist net hold two wires: in its mass, and in the force of a cell solved by "
    "hand") {
  // 8 x 10: openings 0.08 m wide on rows 0.07 m apart, a twist of 0.04 m and two sides of 0.05 m each.
  const auto net = hexagonal();
  CHECK(net.mass_per_area() == Approx(7850 * area * (2 * 0.04 + 2 * 0.05) / (0.08 * 0.07)).epsilon(1e-12));

  // Pulled along both axes the cell stays symmetric: one length is unknown, that of the twists. Each bears what the
  // two slanted sides at its end bear along it.
  const double stretch_x = 1.03, stretch_y = 1.02, half_width = 0.04 * stretch_x, row = 0.07 * stretch_y;
  const auto tension = [](double wires, double now, double before) {
    return wires * EA * (now * now - before * before) / (2 * before * before) * now / before;
  };
  double shortest = 0.04, longest = row;  // of a twist, which leaves the sides row - twist to rise by
  const auto side_at = [&](double twist) { return std::hypot(half_width, row - twist); };
  for (int step = 0; step < 100; ++step) {
    const double twist = 0.5 * (shortest + longest), side = side_at(twist);
    const bool pulls_more = tension(2, twist, 0.04) > 2 * tension(1, side, 0.05) * (row - twist) / side;
    (pulls_more ? longest : shortest) = twist;
  }
  const double twist = 0.5 * (shortest + longest), side = side_at(twist);
  fem::NetResponse response(net);
  response.stretch_to({0.5 * (stretch_x * stretch_x - 1), 0.5 * (stretch_y * stretch_y - 1), 0});
  // A cut along the twists meets one side in each row, a cut across them a twist in each opening; second
  // Piola-Kirchhoff forces are those over the stretch.
  const auto force = response.membrane_force();
  CHECK(force.xx == Approx(tension(1, side, 0.05) * half_width / side / 0.07 / stretch_x).epsilon(1e-8));
  CHECK(force.yy == Approx(tension(2, twist, 0.04) / 0.08 / stretch_y).epsilon(1e-8));
}

TEST_CASE("a net that is slack up to the strain asked for is refused") {
  const auto net = fem::periodic_net(lattice(mesh::SquarePattern{.pitch = pitch}), cable(-1e9), 7850);
  CHECK_THROWS_WITH(fem::fit_sheet(net, {.strain = 1e-3, .thickness = 1}),
                    Catch::Contains("carries nothing along x"));
}
