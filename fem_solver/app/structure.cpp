#include "fem_solver/app/structure.hpp"

#include <fmt/format.h>

#include "core/units/units.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/scene/build_model.hpp"

namespace talus::fem {
namespace {

constexpr const char* structure_help =
    "the structure: parts, how they are held, loaded and damped, and how they move through time";

/// The step where the scene names none. Far enough below the limit that stretched cables may stiffen, and
/// that cables which snap taut keep the energy balance (measured in docs/step_limits.md).
constexpr double default_share_of_limit = 0.5;

double chosen_step(const StructuralScene& scene, const std::vector<StepBound>& bounds) {
  if (scene.structure.step) return *scene.structure.step;
  if (scene.time.step) return *scene.time.step;
  return bounds.empty() ? scene.time.end : default_share_of_limit * bounds.front().seconds;
}

}  // namespace

StructuralScene read_structural_scene(const core::SceneFile& file) {
  core::SceneReader reader(file);
  StructuralScene scene;
  scene.time = reader.required<core::TimeScene>("time");
  scene.output = reader.optional<core::OutputScene>("output").value_or(core::OutputScene{});
  scene.structure = reader.required<StructureScene>("structure");
  reader.finish();
  return scene;
}

std::string structure_schema() {
  return core::schema_markdown("structure", structure_help, [](core::Fields& fields) {
    StructureScene scene;
    describe(fields, scene);
  });
}

std::vector<StructuralEffect> structural_effects(const StructureScene& scene) {
  const auto named = [](const char* effect, const char* key, bool present) {
    return StructuralEffect{effect, present,
                            fmt::format("structure.{} is {}", key, present ? "given" : "not given")};
  };
  std::vector<StructuralEffect> effects;
  for (const auto& [name, part] : scene.parts)
    effects.push_back(
        {fmt::format("elements of {}", name), true, fmt::format("structure.parts.{} is given", name)});
  effects.push_back(named("gravity on the structure", "gravity", scene.gravity.has_value()));
  effects.push_back(
      named("mass-proportional damping", "damping.mass", scene.damping && scene.damping->mass > 0));
  effects.push_back(named("stiffness-proportional damping", "damping.stiffness",
                          scene.damping && scene.damping->stiffness > 0));
  effects.push_back(named("nodal loads", "loads", !scene.loads.empty()));
  effects.push_back(named("point masses", "point_masses", !scene.point_masses.empty()));
  effects.push_back(named("welded parts", "weld", scene.weld.has_value()));
  return effects;
}

Structure::Structure(const StructuralScene& scene)
    : model_(build_model(scene.structure)),
      assembly_(model_),
      bounds_(step_bounds(assembly_, std::vector<double>(model_.reference.size(), 0.0))),
      step_(chosen_step(scene, bounds_)),
      output_scene_(scene.output) {
  check_step(scene.structure);
  integrator_ = std::make_unique<ExplicitSolver>(model_, assembly_, step_);
}

void Structure::check_step(const StructureScene& scene) const {
  if (scene.unstable_step == StructureScene::UnstableStep::allowed || bounds_.empty()) return;
  const StepBound& bound = bounds_.front();
  if (step_ <= bound.seconds) return;
  throw core::ConfigError(
      fmt::format("structure: the step of {} is above the limit of stability, {}: {}, {}. Take a smaller "
                  "step, or write `unstable_step: allowed`",
                  core::readable(step_, "s"), core::readable(bound.seconds, "s"), bound.name, bound.reason));
}

void Structure::make_interface(const std::vector<Index>& nodes) {
  integrator_->interface().nodes = nodes;
  integrator_->interface().force.assign(3 * nodes.size(), 0.0);
}

const StructureOutput& Structure::output() {
  if (!output_) output_ = std::make_unique<StructureOutput>(model_, *integrator_, output_scene_);
  return *output_;
}

}  // namespace talus::fem
