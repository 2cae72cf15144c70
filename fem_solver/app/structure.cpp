#include "fem_solver/app/structure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/output/checkpoint.hpp"
#include "core/program/log.hpp"
#include "core/units/units.hpp"
#include "fem_solver/integration/equilibrium.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/implicit_solver.hpp"
#include "fem_solver/integration/relaxation.hpp"
#include "fem_solver/integration/static_solver.hpp"
#include "fem_solver/scene/build_model.hpp"

namespace talus::fem {
namespace {

constexpr const char* structure_help =
    "the structure: parts, how they are held, loaded and damped, and how they move through time";

/// The step where the scene names none. Far enough below the limit that stretched cables may stiffen, and
/// that cables which snap taut keep the energy balance (measured in docs/step_limits.md).
constexpr double default_share_of_limit = 0.5;

bool is_watched(const StructureScene& scene) {
  return scene.unstable_step == StructureScene::UnstableStep::refused;
}

std::string description(const AddedMass& added) {
  return fmt::format("mass scaling adds {:.4g} kg, {:.3g} % of the structure, at {} nodes", added.kilograms,
                     100 * added.share, added.nodes);
}

RelaxationOptions options_of(const RelaxationScene& scene) {
  return {.most_steps = scene.steps, .tolerance = scene.tolerance};
}

/// Of the same structure at the end of another run, perhaps by another method.
State state_after(const std::filesystem::path& file, const Model& model) {
  core::CheckpointReader reader(file, {"fem_solver explicit", "fem_solver implicit", "fem_solver static"});
  State state = initial_state(model);
  std::vector<double> reference(model.reference.size());
  reader.values("reference", reference);
  if (reference != model.reference)
    throw core::ConfigError(fmt::format(
        "structure.start.after.state: {} is of a structure with nodes at other places", file.string()));
  archive(reader, state);
  return state;
}

State start_of(const StructureScene& scene, Assembly& assembly) {
  if (!scene.start) return initial_state(assembly.model());
  if (const auto* newton = std::get_if<EquilibriumScene>(&scene.start->from))
    return equilibrium(assembly.model(), assembly,
                       {.steps = newton->steps, .newton = {.tolerance = newton->tolerance}});
  if (const auto* falls = std::get_if<RelaxationScene>(&scene.start->from))
    return relax(assembly.model(), assembly, options_of(*falls), initial_state(assembly.model()));
  const auto& after = std::get<AfterScene>(scene.start->from);
  State state = state_after(after.state, assembly.model());
  if (after.motion == AfterScene::Motion::goes_on) return state;
  return relax(assembly.model(), assembly, options_of(after), std::move(state));
}

std::vector<StepBound> bounds_of(const StructureScene& scene, Assembly& assembly, const State& start) {
  if (!is_explicit(scene.method)) return {};
  return step_bounds(assembly, start.configuration());
}

double chosen_step(const StructuralScene& scene, const std::vector<StepBound>& bounds) {
  if (const auto* loads = std::get_if<StaticScene>(&scene.structure.method))
    return scene.time.end / static_cast<double>(loads->steps);
  if (scene.structure.step) return *scene.structure.step;
  if (scene.time.step) return *scene.time.step;
  if (bounds.empty())
    throw core::ConfigError("structure: an implicit run needs `structure.step` or `time.step`");
  return default_share_of_limit * bounds.front().seconds;
}

StructuralEffect effect_at(const std::string& name, const std::string& key, bool present) {
  return {name, present, fmt::format("{} is {}", key, present ? "given" : "not given"), key};
}

/// A part's elements, and what they know beyond elasticity.
void add_effects_of_part(std::vector<StructuralEffect>& effects, const std::string& part,
                         const ElementScene& element) {
  const std::string key = "structure.parts." + part, compression = "compression of " + part;
  const auto add = [&](const char* effect, const char* suffix, bool present) -> StructuralEffect& {
    return effects.emplace_back(effect_at(fmt::format("{} of {}", effect, part), key + suffix, present));
  };
  const auto dissipating = [&](const char* effect, const char* suffix) {
    add(effect, suffix, true).ledger_line = "structure.dissipated_" + part + "_J";
  };
  add("elements", "", true);
  if (const auto* sheet = std::get_if<MembraneScene>(&element))
    add("tension field", ".membrane.tension_field", sheet->tension_field.has_value()).limit = compression;
  std::visit(
      [&](const auto& scene) {
        if constexpr (requires { scene.breaks; })
          if (scene.breaks) dissipating("breaking", "");
      },
      element);
  if (std::holds_alternative<BarScene>(element)) add("slackness", ".cable", false).limit = compression;
  if (const auto* rope = std::get_if<SlidingCableScene>(&element))
    add("friction", ".sliding_cable.friction", rope->has_friction());  // it may hold, without any work
  if (std::holds_alternative<ElasticPlasticCableScene>(element))
    dissipating("yielding", ".elastic_plastic_cable");
  if (std::holds_alternative<BrakeScene>(element)) dissipating("braking", ".brake");
  if (std::holds_alternative<RingScene>(element)) dissipating("bending of rings", ".ring");
}

/// The integrator that a method of the scene means.
struct MakeIntegrator {
  const Model& model;
  Assembly& assembly;
  const State& start;
  struct Times {
    double step = 0, end = 0;  ///< s
    bool watched = true;       ///< an explicit run ends where its step becomes unstable
  } times;

  using Made = std::unique_ptr<Integrator>;
  Made operator()(std::monostate) const { return (*this)(ExplicitScene{}); }
  Made operator()(const ExplicitScene&) const {
    auto solver = std::make_unique<ExplicitSolver>(model, assembly, times.step, start);
    if (times.watched) solver->watch_step();
    return solver;
  }
  Made operator()(const ImplicitScene& scene) const {
    return std::make_unique<ImplicitSolver>(model, assembly,
                                            ImplicitOptions{.step = times.step,
                                                            .spectral_radius = scene.spectral_radius,
                                                            .newton = {.tolerance = scene.tolerance}},
                                            start);
  }
  Made operator()(const StaticScene& scene) const {
    return std::make_unique<StaticSolver>(
        model, assembly,
        StaticOptions{.end = times.end, .step = times.step, .newton = {.tolerance = scene.tolerance}}, start);
  }
};

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

Structure::Structure(const StructuralScene& scene)
    : model_(build_model(scene.structure)),
      added_mass_(scene.structure.mass_scaling ? scale_masses(model_, scene.structure.mass_scaling->step)
                                               : AddedMass{}),
      assembly_(model_),
      start_(start_of(scene.structure, assembly_)),
      bounds_(bounds_of(scene.structure, assembly_, start_)),
      step_(chosen_step(scene, bounds_)),
      implicit_(std::holds_alternative<ImplicitScene>(scene.structure.method)),
      output_scene_(scene.output) {
  check_step(scene.structure);
  if (scene.output.largest_forces) start_.record = ForceRecord(model_).begin();
  if (scene.structure.mass_scaling) core::log_warning(description(added_mass_));
  integrator_ = std::visit(
      MakeIntegrator{model_, assembly_, start_, {step_, scene.time.end, is_watched(scene.structure)}},
      scene.structure.method);
  if (!scene.output.stage_times) return;
  clock_ = std::make_unique<core::StageClock>("structure", stages_of(model_));
  assembly_.measure_stages(*clock_);
}

std::vector<StructuralEffect> Structure::effects(const StructureScene& scene) const {
  std::vector<StructuralEffect> effects;
  const auto add = [&](const char* effect, const char* key, bool present) -> StructuralEffect& {
    return effects.emplace_back(effect_at(effect, std::string("structure.") + key, present));
  };
  for (const auto& [name, part] : scene.parts) {
    if (has_no_element(part)) continue;
    add_effects_of_part(effects, name, part.element);
    const std::string key = "parts." + name;
    if (part.gravity)
      add(("gravity on " + name).c_str(), (key + ".gravity").c_str(), true).ledger_line =
          "structure.gravity_J";
    if (part.damping)
      add(("damping of " + name).c_str(), (key + ".damping").c_str(), true).ledger_line =
          "structure.bulk_damping_J";
  }
  const auto& damping = scene.damping;
  add("gravity on the structure", "gravity", scene.gravity.has_value()).ledger_line = "structure.gravity_J";
  add("mass-proportional damping", "damping.mass", damping && damping->mass > 0).ledger_line =
      "structure.bulk_damping_J";
  add("stiffness-proportional damping", "damping.stiffness", damping && damping->stiffness > 0).ledger_line =
      "structure.bulk_damping_J";
  add("nodal loads", "loads", !scene.loads.empty());
  add("point masses", "point_masses", !scene.point_masses.empty());
  add("welded parts", "weld", scene.weld.has_value());
  add("nodes that slide along ropes", "slides", !scene.slides.empty());
  add("obstacles that stop nodes", "obstacles", !scene.obstacles.empty());
  add("start at rest under loads", "start", scene.start.has_value());
  add("mass scaling", "mass_scaling", scene.mass_scaling.has_value());
  if (scene.mass_scaling) effects.back().reason += "; " + description(added_mass_);
  return effects;
}

void Structure::check_step(const StructureScene& scene) const {
  if (!is_watched(scene) || bounds_.empty()) return;
  const double rate = model_.damping_rates.empty() ? 0 : *std::ranges::max_element(model_.damping_rates);
  if (step_ * rate > 2)  // (1 - rate step/2)/(1 + rate step/2) is left of a velocity
    throw core::ConfigError(fmt::format(
        "structure: a mass damping of {:.4g} 1/s turns velocities round within the step of {}, where it "
        "should only brake them. Take a step of at most {}, or less damping",
        rate, core::readable(step_, "s"), core::readable(2 / rate, "s")));
  const StepBound& bound = bounds_.front();
  if (step_ <= bound.seconds) return;
  throw core::ConfigError(
      fmt::format("structure: the step of {} is above the limit of stability, {}: {}, {}. Take a smaller "
                  "step, or write `unstable_step: allowed`",
                  core::readable(step_, "s"), core::readable(bound.seconds, "s"), bound.name, bound.reason));
}

void Structure::make_interface(const std::vector<Index>& nodes) {
  integrator_->interface() = InterfaceForce(nodes);
}

void Structure::write_checkpoint(const std::filesystem::path& path) {
  core::CheckpointWriter writer(path, integrator_->method());
  integrator_->archive(writer);
  writer.values("reference", model_.reference);
  writer.commit();
}

void Structure::read_checkpoint(const std::filesystem::path& path) {
  core::CheckpointReader reader(path, integrator_->method());
  integrator_->archive(reader);
}

const StructureOutput& Structure::output() {
  if (!output_)
    output_ = std::make_unique<StructureOutput>(model_, *integrator_, output_scene_, clock_.get());
  return *output_;
}

}  // namespace talus::fem
