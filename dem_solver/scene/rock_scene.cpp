#include "dem_solver/scene/rock_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "core/scene/plausible.hpp"
#include "dem_solver/rocks/ball_union.hpp"
#include "dem_solver/rocks/closed_surface.hpp"
#include "dem_solver/rocks/eota_block.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/rocks/surface_cover.hpp"
#include "dem_solver/scene/triple_of.hpp"

namespace talus::dem {

namespace {
constexpr const char* spacing_help =
    "of spheres along the surface, each for the share of it next to it, in place of filling ones: what the "
    "law "
    "`foundation` needs";
}

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
  fields.choice(
      "form", block.form, {"cut_corners", "eota_111", "eota_221"},
      "a cube without its corners, or a test block of EAD 340059 with 26 faces, 1 : 1 : 1 or 2 : 2 : 1 (flat "
      "along z)");
  fields.optional("edge", block.edge,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "of the cube before it is cut",
                   .plausible = core::plausible::rock_size});
  fields.optional("mass", block.mass,
                  {.unit = "kg",
                   .range = core::positive,
                   .help = "gives the edge, with the material's density",
                   .plausible = core::plausible::rock_mass});
  fields.optional(
      "cut", block.cut,
      {.range = cut_range, .help = "part of the edge that is cut off at each corner; absent: 0.25"});
  fields.rule(!block.cut || block.form == BlockScene::Form::cut_corners, "cut",
              "is for `form: cut_corners`; the test blocks have theirs");
  fields.optional(
      "deviation", block.deviation,
      {.unit = "m", .range = core::positive, .help = "of the filling spheres; absent: 5 % of the edge"});
  fields.optional("spacing", block.spacing, {.unit = "m", .range = core::positive, .help = spacing_help});
  fields.rule(!(block.deviation && block.spacing), "spacing",
              "contradicts `deviation`, which fills the block");
  fields.rule(block.edge.has_value() != block.mass.has_value(), "edge",
              "needs exactly one of `edge` and `mass`");
}

void describe(core::Fields& fields, SurfaceScene& surface) {
  describe(fields, surface.file);
  fields.optional("deviation", surface.deviation,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "how far the filling spheres may stay from the surface"});
  fields.optional("spacing", surface.spacing, {.unit = "m", .range = core::positive, .help = spacing_help});
  fields.rule(
      surface.deviation.has_value() != surface.spacing.has_value(), "deviation",
      "needs exactly one of `deviation` (filled with spheres) and `spacing` (spheres along the surface)");
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
  std::vector<double> areas;          ///< m^2; of the surface, a share a ball
  std::vector<core::Vector3> facing;  ///< a ball: out of that share, zero where it looks every way
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
  shape.areas = shown_areas(shape.balls);
  shape.facing.assign(shape.balls.size(), core::Vector3::Zero());
  shape.moments = union_moments(shape.balls);
  return shape;
}

/// Spheres that fill a surface up to a deviation, or lie along it at a spacing.
struct Resolution {
  double deviation = 0;
  std::optional<double> spacing;
};

Shape with_spheres(const std::string& name, mesh::Surface surface, const Resolution& wanted) {
  const std::string place = "particles.rocks." + name;
  if (const std::string fault = closed_surface_fault(surface); !fault.empty())
    throw core::ConfigError(place + ": " + fault);
  Shape shape;
  if (wanted.spacing) {
    SurfaceCover cover = cover_with_spheres(surface, {.spacing = *wanted.spacing});
    shape.balls = std::move(cover.balls);
    shape.areas = std::move(cover.areas);
    shape.facing = std::move(cover.facing);
    shape.deviation = cover.deviation;
  } else {
    SphereFilling filling = fill_with_spheres(surface, {.deviation = wanted.deviation});
    shape.balls = std::move(filling.balls);
    shape.areas.assign(shape.balls.size(), 0);
    shape.facing.assign(shape.balls.size(), core::Vector3::Zero());
    shape.deviation = filling.deviation;
  }
  core::log_info(
      fmt::format("{}: {} spheres stand for the surface; of its {} nodes the furthest is {:.4g} m away from "
                  "them, for a {} of {:.4g} m",
                  place, shape.balls.size(), surface.node_count(), shape.deviation,
                  wanted.spacing ? "spacing" : "deviation", wanted.spacing.value_or(wanted.deviation)));
  shape.moments = polyhedron_moments(surface);
  shape.surface = std::move(surface);
  return shape;
}

Shape shape_of(const std::string& name, const BlockScene& block, double density) {
  const bool flat = block.form == BlockScene::Form::eota_221;
  const double cut = block.cut.value_or(0.25);
  const auto edge_of = [&](double volume) {
    return block.form == BlockScene::Form::cut_corners ? block_edge(volume, cut) : eota_edge(volume, flat);
  };
  const double edge = block.edge ? *block.edge : edge_of(*block.mass / density);
  mesh::Surface surface = block.form == BlockScene::Form::cut_corners
                              ? make_block({.edge = edge, .cut = cut})
                              : make_eota_block({.edge = edge, .flat = flat});
  return with_spheres(name, std::move(surface), {block.deviation.value_or(0.05 * edge), block.spacing});
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
  return with_spheres(name, std::move(surface), {scene.deviation.value_or(0), scene.spacing});
}

Eigen::Quaterniond rotation_of(const core::Vector3& turned) {
  const double angle = turned.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turned / angle))
                   : Eigen::Quaterniond::Identity();
}

}  // namespace

bool stands_for_surface(const RockScene& rock) {
  if (const auto* block = std::get_if<BlockScene>(&rock.shape)) return block->spacing.has_value();
  if (const auto* surface = std::get_if<SurfaceScene>(&rock.shape)) return surface->spacing.has_value();
  return true;  // the spheres are the surface
}

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
  for (std::size_t k = 0; k < shape.balls.size(); ++k) {
    const Ball& ball = shape.balls[k];
    const core::Vector3 arm = turn * (ball.centre - mass.centre);
    built.spheres.push_back({.position = triple_of(scene.at + arm),
                             .velocity = triple_of(scene.velocity + scene.spin.cross(arm)),
                             .spin = triple_of(scene.spin),
                             .radius = ball.radius,
                             .mass = mass.mass,
                             .material = 0,
                             .rock = -1,
                             .area = shape.areas[k],
                             .facing = triple_of(turn * shape.facing[k])});
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
