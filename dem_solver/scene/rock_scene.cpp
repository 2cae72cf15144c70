#include "dem_solver/scene/rock_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "core/scene/plausible.hpp"
#include "dem_solver/rocks/ball_union.hpp"
#include "dem_solver/rocks/closed_surface.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/scene/triple_of.hpp"

namespace talus::dem {

void describe(core::Fields& fields, SpheresShapeScene& shape) {
  fields.required("centres", shape.centres, {.unit = "m", .help = "of the spheres, in any frame"});
  fields.required("radii", shape.radii,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "one a sphere",
                   .plausible = core::plausible::rock_size});
  fields.rule(!shape.centres.empty() && shape.centres.size() == shape.radii.size(), "radii",
              "needs as many radii as centres");
}

void describe(core::Fields& fields, BlockScene& block) {
  constexpr core::Range cut_range{.low = 0, .high = 0.5, .low_included = false, .high_included = false};
  fields.optional("edge", block.edge,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "of the cube before its corners are cut",
                   .plausible = core::plausible::rock_size});
  fields.optional("mass", block.mass,
                  {.unit = "kg",
                   .range = core::positive,
                   .help = "gives the edge, with the material's density",
                   .plausible = core::plausible::rock_mass});
  fields.with_default("cut", block.cut,
                      {.range = cut_range, .help = "part of the edge that is cut off at each corner"});
  fields.optional(
      "deviation", block.deviation,
      {.unit = "m", .range = core::positive, .help = "of the filling spheres; absent: 5 % of the edge"});
  fields.rule(block.edge.has_value() != block.mass.has_value(), "edge",
              "needs exactly one of `edge` and `mass`");
}

void describe(core::Fields& fields, SurfaceScene& surface) {
  describe(fields, surface.file);
  fields.required("deviation", surface.deviation,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "how far the filling spheres may stay from the surface"});
}

void describe(core::Fields& fields, RockScene& rock) {
  fields.required("material", rock.material, {.help = "contact material; its density gives the mass"});
  fields.one_of(rock.shape, {{"spheres", "the union of spheres"},
                             {"block", "a cube without its corners, like the blocks of type tests"},
                             {"surface", "a closed surface from a file, filled with spheres"}});
  fields.required("at", rock.at, {.unit = "m", .help = "the centre of mass at time 0"});
  fields.with_default("velocity", rock.velocity,
                      {.unit = "m/s", .help = "at time 0", .plausible = core::plausible::velocity});
  fields.with_default(
      "spin", rock.spin,
      {.unit = "rad/s", .help = "angular velocity at time 0", .plausible = core::plausible::spin});
  fields.with_default("turned", rock.turned,
                      {.unit = "rad",
                       .help = "rotation vector that turns the shape before time 0",
                       .plausible = core::plausible::rotation});
}

namespace {

/// A shape in the frame it was given in.
struct Shape {
  std::vector<Ball> balls;
  VolumeMoments moments;
  mesh::Surface surface;
  double deviation = 0;  ///< m; of its nodes from the balls
};

/// The centre of mass is put at `at`, so the frame of a file or list does not matter: the shape is brought
/// near the origin, where moments lose no digits to coordinates of a map.
Shape shape_of(const std::string&, const SpheresShapeScene& scene, double) {
  Shape shape;
  for (std::size_t k = 0; k < scene.centres.size(); ++k)
    shape.balls.push_back({scene.centres[k] - scene.centres[0], scene.radii[k]});
  shape.moments = union_moments(shape.balls);
  return shape;
}

Shape filled(const std::string& name, mesh::Surface surface, double deviation) {
  const std::string place = "particles.rocks." + name;
  if (const std::string fault = closed_surface_fault(surface); !fault.empty())
    throw core::ConfigError(place + ": " + fault);
  Shape shape;
  const SphereFilling filling = fill_with_spheres(surface, {.deviation = deviation});
  core::log_info(
      fmt::format("{}: {} spheres stand for the surface; of its {} nodes the furthest is {:.4g} m away from "
                  "them, for a deviation of {:.4g} m",
                  place, filling.balls.size(), surface.node_count(), filling.deviation, deviation));
  shape.balls = filling.balls;
  shape.deviation = filling.deviation;
  shape.moments = polyhedron_moments(surface);
  shape.surface = std::move(surface);
  return shape;
}

Shape shape_of(const std::string& name, const BlockScene& block, double density) {
  const double edge = block.edge ? *block.edge : block_edge(*block.mass / density, block.cut);
  return filled(name, make_block({.edge = edge, .cut = block.cut}), block.deviation.value_or(0.05 * edge));
}

void centre(mesh::Surface& surface) {
  Eigen::Map<Eigen::Matrix3Xd> nodes(surface.positions.data(), 3, surface.node_count());
  const core::Vector3 middle = 0.5 * (nodes.rowwise().minCoeff() + nodes.rowwise().maxCoeff());
  nodes.colwise() -= middle;
}

Shape shape_of(const std::string& name, const SurfaceScene& scene, double) {
  mesh::Surface surface = mesh::generate(scene.file).surface;
  if (!surface.segments.empty())
    throw core::ConfigError(
        fmt::format("particles.rocks.{}: the file holds {} lines beside its triangles, which are no "
                    "part of a solid: take the triangles alone (`part`)",
                    name, surface.segments.size()));
  centre(surface);
  if (turn_outwards(surface))
    core::log_info("particles.rocks." + name + ": the surface was inside out and is turned over");
  return filled(name, std::move(surface), scene.deviation);
}

Eigen::Quaterniond rotation_of(const core::Vector3& turned) {
  const double angle = turned.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turned / angle))
                   : Eigen::Quaterniond::Identity();
}

}  // namespace

BuiltRock build_rock(const std::string& name, const RockScene& scene, double density) {
  const Shape shape =
      std::visit([&](const auto& kind) { return shape_of(name, kind, density); }, scene.shape);
  const MassProperties mass = mass_properties(shape.moments, density);
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(mass.inertia);
  Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;  // a right-handed frame
  const Eigen::Quaterniond turn = rotation_of(scene.turned);
  const Eigen::Quaterniond q = (turn * Eigen::Quaterniond(axes)).normalized();

  BuiltRock built;
  built.rock = {.mass = mass.mass,
                .moments = triple_of(principal.eigenvalues()),
                .centre = triple_of(scene.at),
                .orientation = {q.x(), q.y(), q.z(), q.w()},
                .velocity = triple_of(scene.velocity),
                .spin = triple_of(scene.spin)};
  for (const Ball& ball : shape.balls) {
    const core::Vector3 arm = turn * (ball.centre - mass.centre);
    built.spheres.push_back({.position = triple_of(scene.at + arm),
                             .velocity = triple_of(scene.velocity + scene.spin.cross(arm)),
                             .spin = triple_of(scene.spin),
                             .radius = ball.radius,
                             .mass = mass.mass});
  }
  built.deviation = shape.deviation;
  built.surface = shape.surface;
  for (mesh::Index i = 0; i < built.surface.node_count(); ++i) {
    Eigen::Map<core::Vector3> p(&built.surface.positions[3 * i]);
    p = axes.transpose() * (p - mass.centre).eval();
  }
  return built;
}

}  // namespace talus::dem
