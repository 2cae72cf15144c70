#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem_solver/rocks/ball_union.hpp"
#include "dem_solver/rocks/closed_surface.hpp"
#include "dem_solver/rocks/eota_block.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;
using std::numbers::pi;

namespace {

/// Volume and moments about the base plane's centre of a ball's part beyond a plane at distance h from its
/// centre (spherical cap of z > h), by the integrals of pi (R^2 - z^2) and its powers.
struct Cap {
  double volume, first, axial, radial;  ///< integrals of 1, z, z^2 and x^2 over R^2 - z^2 > x^2 + y^2, z > h

  Cap(double r, double h) {
    const auto integral = [&](auto antiderivative) { return antiderivative(r) - antiderivative(h); };
    volume = pi * integral([&](double z) { return r * r * z - z * z * z / 3; });
    first = pi * integral([&](double z) { return r * r * z * z / 2 - std::pow(z, 4) / 4; });
    axial = pi * integral([&](double z) { return r * r * z * z * z / 3 - std::pow(z, 5) / 5; });
    radial = pi / 4 * integral([&](double z) {
               return std::pow(r, 4) * z - 2 * r * r * z * z * z / 3 + std::pow(z, 5) / 5;
             });
  }
};

}  // namespace

TEST_CASE("Two overlapping balls have the mass and inertia of the closed form") {
  const double r = 0.3, half = GENERATE(0.1, 0.2, 0.29), density = 2600;
  const core::Vector3 axis = core::Vector3(1, 2, 3).normalized(), centre(4, 5, 6);
  const std::vector<Ball> balls{{centre - half * axis, r}, {centre + half * axis, r}};
  const MassProperties mass = mass_properties(union_moments(balls), density);

  // Each half is a ball less the cap beyond the symmetry plane, which lies `half` from its centre.
  const Cap cap(r, half);
  const double ball = 4.0 / 3 * pi * r * r * r, ball_second = ball * r * r / 5;
  const double volume = ball - cap.volume, first = -cap.first, axial = ball_second - cap.axial,
               radial = ball_second - cap.radial;
  // Along the axis, from the symmetry plane: the half's points are at -half + z.
  const double axial_about_centre = axial - 2 * half * first + half * half * volume;
  const double polar = 2 * density * 2 * radial, transverse = 2 * density * (radial + axial_about_centre);
  const double tolerance = 1e-6;
  CHECK(mass.mass == Approx(2 * density * volume).epsilon(tolerance));
  CHECK((mass.centre - centre).norm() < 1e-6 * r);
  CHECK(axis.dot(mass.inertia * axis) == Approx(polar).epsilon(tolerance));
  const core::Vector3 across = axis.cross(core::Vector3::UnitX()).normalized();
  CHECK(across.dot(mass.inertia * across) == Approx(transverse).epsilon(tolerance));
}

TEST_CASE("A block's mass properties are those of the closed form") {
  const double edge = 1.2, cut = 0.25;
  const mesh::Surface block = make_block({edge, cut});
  REQUIRE(closed_surface_fault(block).empty());
  const VolumeMoments m = polyhedron_moments(block);
  // A cube less eight corner tetrahedra with legs cut*edge: volume leg^3/6 each, at leg/4 from the corner
  // along each axis, second moment leg^5/60 about the corner's faces.
  const double leg = cut * edge, h = edge / 2, tetrahedron = leg * leg * leg / 6;
  const double second_corner = tetrahedron * h * h - 2 * h * tetrahedron * leg / 4 + std::pow(leg, 5) / 60;
  CHECK(m.volume == Approx(std::pow(edge, 3) - 8 * tetrahedron).epsilon(1e-13));
  CHECK(m.first.norm() < 1e-13);
  for (int k = 0; k < 3; ++k)
    CHECK(m.second(k, k) == Approx(std::pow(edge, 5) / 12 - 8 * second_corner).epsilon(1e-12));
  CHECK(block_edge(m.volume, cut) == Approx(edge).epsilon(1e-13));
}

TEST_CASE("The test blocks have 26 faces, the volume and the inertia that the guideline's corners give") {
  const bool flat = GENERATE(false, true);
  const double edge = 1.2, density = 2500;
  const mesh::Surface block = make_eota_block({edge, flat});
  REQUIRE(closed_surface_fault(block).empty());
  CHECK(block.triangles.size() == 6 * 2 + 12 * 2 + 8);  // squares, rectangles, triangles
  const MassProperties mass = mass_properties(polyhedron_moments(block), density);
  const double volume = (flat ? 0.5 : 1.0) * 17.0 / 24 * edge * edge * edge;
  CHECK(mass.mass == Approx(density * volume).epsilon(1e-12));
  CHECK(eota_edge(volume, flat) == Approx(edge).epsilon(1e-12));
  CHECK(mass.centre.norm() < 1e-12);
  // 0.1235 m L^2 about every axis of the cubic one, to the published digits; each half is an integral of x^2.
  const double along = 0.1235 / 2 * mass.mass * edge * edge, up = flat ? along / 4 : along;
  CHECK(mass.inertia(0, 0) == Approx(along + up).epsilon(1e-3));
  CHECK(mass.inertia(2, 2) == Approx(2 * along).epsilon(1e-3));
}

TEST_CASE("A filling's spheres stay inside the rock and come closer to it with a smaller deviation") {
  const mesh::Surface block = make_block({1, 0.25});
  double last = 1;
  for (double deviation : {0.2, 0.1}) {
    const SphereFilling filling = fill_with_spheres(block, {.deviation = deviation});
    for (const Ball& ball : filling.balls) {
      for (int k = 0; k < 3; ++k) REQUIRE(std::abs(ball.centre[k]) + ball.radius <= 0.5 + 1e-12);
      // The faces cut off the corners: |x| + |y| + |z| = 3/2 - 1/4.
      REQUIRE(ball.centre.lpNorm<1>() + std::sqrt(3.0) * ball.radius <= 1.25 + 1e-12);
    }
    double largest = 0;
    for (mesh::Index node = 0; node < block.node_count(); ++node) {
      const core::Vector3 at = core::Vector3::Map(&block.positions[3 * static_cast<std::size_t>(node)]);
      double nearest = 1;
      for (const Ball& ball : filling.balls)
        nearest = std::min(nearest, (ball.centre - at).norm() - ball.radius);
      largest = std::max(largest, nearest);
    }
    CHECK(filling.deviation == Approx(largest).epsilon(1e-12));
    CHECK(largest < last);
    last = largest;
  }
}

TEST_CASE("The spheres of a filled rock approach its volume and inertia as they become more") {
  const mesh::Surface block = make_block({1, 0.25});
  const MassProperties solid = mass_properties(polyhedron_moments(block), 1);
  double volume_error = 1, inertia_error = 1;
  std::size_t spheres = 0;
  for (double deviation : {0.2, 0.1}) {
    const SphereFilling filling = fill_with_spheres(block, {.deviation = deviation});
    const MassProperties filled = mass_properties(union_moments(filling.balls), 1);
    const double volume_now = 1 - filled.mass / solid.mass,
                 inertia_now = 1 - filled.inertia.trace() / solid.inertia.trace();
    CHECK(filling.balls.size() > spheres);
    // Inscribed spheres leave something out, less each time.
    CHECK(volume_now > 0);
    CHECK(volume_now < 0.75 * volume_error);
    CHECK(inertia_now < 0.75 * inertia_error);
    CHECK(filled.centre.norm() < deviation * deviation);
    spheres = filling.balls.size();
    volume_error = volume_now;
    inertia_error = inertia_now;
  }
}

TEST_CASE("A filled rock has the mass, centre and inertia of its surface, whatever its spheres are") {
  RockScene scene;
  scene.shape = BlockScene{.edge = 0.8, .mass = {}, .cut = 0.25, .deviation = 0.1, .spacing = {}};
  scene.at = {1, 2, 3};
  const double density = 2600;
  const BuiltRock built = build_rock("block", scene, density);
  // A cube less eight corner tetrahedra, as in the test of the block's mass properties.
  const double edge = 0.8, leg = 0.25 * edge, tetrahedron = leg * leg * leg / 6, h = edge / 2;
  const double mass = density * (edge * edge * edge - 8 * tetrahedron);
  const double second =
      density * (std::pow(edge, 5) / 12 -
                 8 * (tetrahedron * h * h - h * tetrahedron * leg / 2 + std::pow(leg, 5) / 60));
  CHECK(built.rock.mass == Approx(mass).epsilon(1e-12));
  CHECK(length(built.rock.centre - Triple<double>{1, 2, 3}) == 0);
  for (double moment : {built.rock.moments.x, built.rock.moments.y, built.rock.moments.z})
    CHECK(moment == Approx(2 * second).epsilon(1e-12));
}

TEST_CASE("A surface with a hole is refused as a rock") {
  mesh::Surface block = make_block({1, 0.25});
  block.triangles.pop_back();
  CHECK_THAT(closed_surface_fault(block), Catch::Contains("not closed"));
}

TEST_CASE(
    "A free asymmetric top keeps its energy over a million steps and turns with its closed form's period") {
  const Triple<double> moments{1, 2, 3.5}, momentum{0.3, 2.1, 0.4};
  const auto energy = [&](const Quaternion& q) {
    return 0.5 * dot(momentum, angular_velocity(q, momentum, moments));
  };
  Quaternion q{0, 0, 0, 1};
  const double start = energy(q), step = 1e-3;
  double worst = 0, before = momentum.y;
  std::vector<double> zeros;  // s; where the momentum along the middle axis of the body changes to positive
  for (int n = 1; n <= 1'000'000; ++n) {
    q = turned(q, {momentum, moments, step});
    if (n % 100 == 0) worst = std::max(worst, std::abs(energy(q) / start - 1));
    const double now = rotate_back(q, momentum).y;
    if (before < 0 && now >= 0) zeros.push_back(step * (n - now / (now - before)));
    before = now;
  }
  // The error of a second-order step oscillates with (w step)^2 ~ 1e-6 and does not grow.
  CHECK(worst < 1e-6);
  CHECK(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w == Approx(1).epsilon(1e-12));
  // Landau and Lifshitz, Mechanics, section 37: T = 4 K(k) sqrt(I1 I2 I3/((I2 - I1) (2 E I3 - M^2))) where
  // M^2 < 2 E I2, k^2 = (I3 - I2) (M^2 - 2 E I1)/((I2 - I1) (2 E I3 - M^2)).
  const double M2 = dot(momentum, momentum), E2 = 2 * start;
  const auto& [I1, I2, I3] = moments;
  REQUIRE(M2 < E2 * I2);
  const double apart = (I2 - I1) * (E2 * I3 - M2);
  const double period =
      4 * std::comp_ellint_1(std::sqrt((I3 - I2) * (M2 - E2 * I1) / apart)) * std::sqrt(I1 * I2 * I3 / apart);
  REQUIRE(zeros.size() > 40);
  CHECK((zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1) ==
        Approx(period).epsilon(1e-5));
}

TEST_CASE("A rock of one sphere moves like the sphere") {
  const SphereCase c{.radius = 0.1, .youngs_modulus = 1e7, .restitution = 0.5, .friction = 0.4, .step = 2e-5};
  const auto run = [&](bool as_rock) {
    ParticleModel model = model_of(c, rigid());
    model.gravity = {0, 0, -9.81};
    model.planes = {floor()};
    model.spheres = {c.sphere({0, 0, 0.12}, {1, 0.5, -1}, {3, 2, 1})};
    if (as_rock) {
      model.spheres[0].rock = 0;
      const double inertia = 0.4 * c.mass() * c.radius * c.radius;
      model.rocks = {{.mass = c.mass(),
                      .moments = {inertia, inertia, inertia},
                      .centre = {0, 0, 0.12},
                      .velocity = {1, 0.5, -1},
                      .spin = {3, 2, 1}}};
    }
    ParticleSolver solver(model);
    for (int n = 0; n < 10000; ++n) solver.step();
    return std::pair{position(solver, 0), spin(solver, 0)};
  };
  const auto [p, w] = run(false);
  const auto [q, u] = run(true);
  CHECK(length(p - q) < 1e-10);
  CHECK(length(w - u) < 1e-9);
}
