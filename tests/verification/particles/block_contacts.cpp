#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "tests/verification/particles/laws_and_bodies.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

constexpr double block_edge_length = 0.4, drop_speed = 0.5;

/// A block that falls on a plane, its lowest point first as it is turned, or on wires along x.
struct Drop {
  core::Vector3 turned = core::Vector3::Zero();
  std::vector<double> wires;  ///< m; their places along y; none: a plane
};
struct BlockImpact {
  double force = 0;  ///< N; the largest
  double speed = 0;  ///< over that of the drop
  double mass = 0;   ///< kg
  double lost = 0;   ///< what the ledger misses, over the impact's energy
};

Boundary wires_at(const std::vector<double>& places) {
  mesh::Surface surface;
  for (const double y : places) {
    const auto first = static_cast<mesh::Index>(surface.node_count());
    surface.positions.insert(surface.positions.end(), {-1, y, -0.01, 1, y, -0.01});
    surface.segments.push_back({first, first + 1});
  }
  surface.parts = {
      {.name = "wires", .wire_radius = 0.01, .segment_end = static_cast<mesh::Index>(places.size())}};
  return Boundary(surface, std::vector<Index>{1});
}

BlockImpact impact_of(const Drop& drop, double spacing) {
  RockScene scene;
  scene.shape =
      BlockScene{.edge = block_edge_length, .mass = {}, .cut = 0.25, .deviation = {}, .spacing = spacing};
  scene.at = {0, 0, 1};
  scene.turned = drop.turned;
  scene.velocity = {0, 0, -drop_speed};
  BuiltRock built = build_rock("block", scene, 2600);
  double lowest = 1;
  for (const SphereInput& sphere : built.spheres)
    lowest = std::min(lowest, sphere.position.z - sphere.radius);
  ParticleModel model = empty_model({Normal::foundation, 0.5});
  if (drop.wires.empty())
    model.planes = {floor()};
  else
    model.boundary = wires_at(drop.wires);
  model.step = 1e-5;
  built.rock.centre.z += 0.001 - lowest;
  for (SphereInput sphere : built.spheres) {
    sphere.position.z += 0.001 - lowest;
    sphere.rock = 0;
    model.spheres.push_back(sphere);
  }
  model.rocks = {built.rock};
  ParticleSolver solver(model);
  const double before = solver.ledger().balance();
  BlockImpact result{.force = until_free(solver),
                     .speed = solver.rocks().velocity(0).z / drop_speed,
                     .mass = built.rock.mass};
  result.lost = std::abs(solver.ledger().balance() / before - 1);
  return result;
}

}  // namespace

TEST_CASE(
    "A block flat on its face meets a plane with the stiffness of that face, however its spheres are "
    "spaced") {
  const double spacing = GENERATE(0.1, 0.05, 0.025);
  const BlockImpact rebound = impact_of({}, spacing);
  // An octagon; the largest force of a mass on a spring is v sqrt(k m), k = k_A A. What the slanting faces beside it add as they
  // come down is in the order of overlap over edge, 1 %.
  const double face = block_edge_length * block_edge_length * (1 - 2 * 0.25 * 0.25);
  CHECK(rebound.force ==
        Approx(drop_speed * std::sqrt(foundation_modulus * face * rebound.mass)).epsilon(0.015));
  CHECK(rebound.speed == Approx(0.5).epsilon(1e-3));
  CHECK(rebound.lost < 1e-3);
}

namespace {

/// N; the largest force on a foundation, whose force is k_A times the volume below the plane, found on a grid of points of the
/// turned block: cube |x|, |y|, |z| < a/2 and |x| + |y| + |z| < 3/2 a - cut.
double largest_force_on_plane(const core::Vector3& turned, double mass) {
  const double a = block_edge_length, cut = 0.25 * a, cell = a / 200, slice = a / 1000;
  const Eigen::Matrix3d back =
      turned.norm() > 0 ? Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix().transpose()
                        : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const auto area = [&](double z) {
    double sum = 0;
    for (double x = -a + 0.5 * cell; x < a; x += cell)
      for (double y = -a + 0.5 * cell; y < a; y += cell) {
        const core::Vector3 p = (back * core::Vector3(x, y, z)).cwiseAbs();
        if (p.maxCoeff() < a / 2 && p.sum() < 1.5 * a - cut) sum += cell * cell;
      }
    return sum;
  };
  double z = -a;
  while (area(z) == 0) z += slice;
  double volume = 0, work = 0;
  for (; work < 0.5 * mass * drop_speed * drop_speed; z += slice) {
    volume += area(z + 0.5 * slice) * slice;
    work += foundation_modulus * volume * slice;
  }
  return foundation_modulus * volume;
}

}  // namespace

TEST_CASE(
    "On an edge, a corner's face and wires a block's force approaches that of a foundation as spheres are "
    "set closer") {
  const double quarter = std::numbers::pi / 4, diagonal = std::acos(1 / std::sqrt(3.0));
  const auto [what, drop] = GENERATE_COPY(table<const char*, Drop>(
      {{"an edge", Drop{.turned = {quarter, 0, 0}, .wires = {}}},
       {"a corner's face",
        Drop{.turned = core::Vector3(1, -1, 0).normalized() * (std::numbers::pi - diagonal), .wires = {}}},
       {"three wires", Drop{.turned = {0, 0, 0}, .wires = {-0.1, 0, 0.1}}}}));
  INFO(what);
  std::vector<double> errors;
  for (const double spacing : {0.05, 0.025, 0.0125}) {
    const BlockImpact impact = impact_of(drop, spacing);
    // Three wires under the whole width of the face: strips of 20 mm x 400 mm.
    const double force =
        drop.wires.empty()
            ? largest_force_on_plane(drop.turned, impact.mass)
            : drop_speed * std::sqrt(foundation_modulus * 3 * 0.02 * block_edge_length * impact.mass);
    errors.push_back(impact.force / force - 1);
    CHECK(impact.speed == Approx(0.5).epsilon(0.01));
    CHECK(impact.lost < 1e-6);
  }
  INFO("errors " << errors[0] << " " << errors[1] << " " << errors[2]);
  CHECK(std::abs(errors[1]) < 0.75 * std::abs(errors[0]));
  CHECK(std::abs(errors[2]) < 0.75 * std::abs(errors[1]));
  CHECK(std::abs(errors[2]) < 0.15);
}

TEST_CASE(
    "Every law with and without friction on planes and faces by both rules closes the ledger of a tumbling "
    "block") {
  const Normal kind = GENERATE(Normal::hertz, Normal::linear, Normal::hysteretic_hertz, Normal::foundation);
  const double friction = GENERATE(0.0, 0.4);
  const bool on_faces = GENERATE(false, true);
  const ContactRule rule =
      on_faces ? GENERATE(ContactRule::local_minima, ContactRule::tangent_plane) : ContactRule::local_minima;
  RockScene scene;
  scene.shape = BlockScene{.edge = 0.4, .mass = {}, .cut = {}, .deviation = {}, .spacing = 0.1};
  scene.at = {0.1, -0.05, 0.36};
  scene.turned = {0.5, 0.3, 0.2};
  // Fast enough for the smallest balls, of some 20 mm beside an edge, to be pressed deeper than their radius: a face goes on pushing as
  // a plane does.
  scene.velocity = {1, 0.5, -2};
  scene.spin = {2, -1, 1};
  const BuiltRock built = build_rock("block", scene, 2600);
  ParticleModel model = empty_model({kind, 0.4});
  if (friction > 0) {
    PairParameters p = model.pairs(0, 1);
    set_friction(p, {.at_rest = friction, .sliding = friction});
    model.pairs.set(0, 1, p);
    model.law.friction = LawChoice::FrictionKind::constant;
  }
  model.gravity = {0, 0, -9.81};
  model.contact_rule = rule;
  if (on_faces) {
    mesh::Surface ground;
    ground.positions = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    ground.parts = {{.name = "ground", .triangle_end = 2}};
    model.boundary = Boundary(ground, std::vector<Index>{1});
  } else {
    model.planes = {floor()};
  }
  model.step = 1e-5;
  model.rocks = {built.rock};
  for (SphereInput sphere : built.spheres) {
    sphere.rock = 0;
    model.spheres.push_back(sphere);
  }
  ParticleSolver solver(model);
  const double start = solver.ledger().balance();
  for (int n = 0; n < 30'000; ++n) solver.step();
  INFO(name_of(kind) << ", friction " << friction << (on_faces ? ", faces" : ", plane"));
  CHECK(solver.ledger().damping > 0.05 * start);  // it has met the ground
  // What the impact leaves to second order in the step, 1e-5 s in contacts of some ms.
  CHECK(solver.ledger().balance() == Approx(start).epsilon(1e-3));
}
