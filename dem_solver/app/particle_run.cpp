#include "dem_solver/app/particle_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/parallel.hpp"
#include "dem_solver/scene/start_check.hpp"

namespace talus::dem {

namespace {

/// A probe of a rock that is not there would be a column that is silently missing.
void check_probes(const RunScene& scene, const core::SceneFile& file, core::SceneReader& reader) {
  std::vector<std::string> names;
  for (const auto& [name, sphere] : scene.particles.spheres) names.push_back(name);
  for (const auto& [name, rock] : scene.particles.rocks) names.push_back(name);
  if (!scene.output) return;
  for (const auto& [name, probe] : scene.output->probes) {
    const auto complain = [&, &name = name](const char* key, const std::string& message) {
      reader.complain({.file = file.path().string(),
                       .key_path = fmt::format("output.probes.{}{}", name, key),
                       .message = message});
    };
    if (probe.rock && std::ranges::find(names, *probe.rock) == names.end())
      complain(".rock", fmt::format("there is no sphere or rock '{}'; known: {}", *probe.rock,
                                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    if (!probe.rock && !file.has_section("structure"))
      complain("", "watches a structure, and the scene has none");
  }
}

}  // namespace

RunScene read_run_scene(const core::SceneFile& file) {
  core::SceneReader reader(file);
  RunScene scene;
  scene.time = reader.required<core::TimeScene>("time");
  scene.output = reader.optional<core::OutputScene>("output");
  scene.particles = reader.required<ParticlesScene>("particles");
  if (!reader.has_complaints()) check_probes(scene, file, reader);
  reader.finish();
  return scene;
}

std::optional<double> own_step(const RunScene& scene) {
  return scene.particles.step ? scene.particles.step : scene.time.step;
}

namespace {

/// As it is at time 0.
mesh::Surface displaced(mesh::Surface surface) {
  for (std::size_t i = 0; i < surface.start.size(); ++i) surface.positions[i] += surface.start[i];
  return surface;
}

ParticleModel model_of(const RunScene& scene, const mesh::Surface& surface, bool moved_by_structure) {
  const int threads = std::max(static_cast<int>(scene.particles.threads), core::thread_count());
  ParticleModel model = build_model(scene.particles, surface,
                                    {.step = own_step(scene).value_or(0),
                                     .ledger = scene.output.has_value(),
                                     .threads = threads,
                                     .moved_by_structure = moved_by_structure});
  if (surface.start.empty()) {
    check_start(scene.particles, model, surface);
    return model;
  }
  const std::vector<double> rest(surface.start.size(), 0.0);
  model.boundary.move({.start_displacement = surface.start, .start_velocity = rest}, {});
  check_start(scene.particles, model, displaced(surface));
  return model;
}

std::unique_ptr<core::StageClock> clock_of(const RunScene& scene) {
  if (!scene.output || !scene.output->stage_times) return nullptr;
  return std::make_unique<core::StageClock>(make_stage_clock());
}

void add_vector(std::vector<core::Fact>& facts, const std::string& name, const Triple<double>& vector,
                const std::string& unit) {
  facts.push_back({name + "_x_" + unit, vector.x});
  facts.push_back({name + "_y_" + unit, vector.y});
  facts.push_back({name + "_z_" + unit, vector.z});
}

/// Which way is down and where walls are: a picture of the result needs both, and no field holds them.
void add_surroundings(const ParticlesScene& particles, const ParticleModel& model,
                      std::vector<core::Fact>& facts) {
  if (particles.gravity) add_vector(facts, "particles.gravity", model.gravity, "m_per_s2");
  for (const Plane& plane : model.planes) {
    add_vector(facts, "particles.planes." + plane.name + ".point", plane.point, "m");
    add_vector(facts, "particles.planes." + plane.name + ".normal", plane.normal, "1");
  }
}

NamedBodies named_bodies(const ParticlesScene& particles, const ParticleModel& model) {
  NamedBodies named{.spheres = {}, .rocks = {}, .facts = model.facts};
  add_surroundings(particles, model, named.facts);
  for (const auto& [name, sphere] : particles.spheres)
    named.spheres.emplace_back(name, static_cast<Index>(named.spheres.size()));
  for (const auto& [name, rock] : particles.rocks)
    named.rocks.emplace_back(name, static_cast<Index>(named.rocks.size()));
  return named;
}

}  // namespace

ParticleRun::ParticleRun(const RunScene& scene, const mesh::Surface& surface,
                         std::span<const double> node_masses)
    : ParticleRun(scene, model_of(scene, surface, !node_masses.empty()), node_masses) {}

ParticleRun::ParticleRun(const RunScene& scene, const ParticleModel& model,
                         std::span<const double> node_masses)
    : solver(model),
      clock(clock_of(scene)),
      output(solver, named_bodies(scene.particles, model), model.rock_surfaces, clock.get()),
      limits(step_limits(model, {.materials = materials_of(scene.particles), .node_masses = node_masses})) {
  if (clock) solver.measure_stages(*clock);
}

std::string schema() {
  return core::schema_markdown("particles", "The particle side: spheres, what they meet, and how.",
                               [](core::Fields& fields) {
                                 ParticlesScene particles;
                                 describe(fields, particles);
                               });
}

}  // namespace talus::dem
