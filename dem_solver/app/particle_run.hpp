#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/scene/reader.hpp"
#include "core/scene/sections.hpp"
#include "dem_solver/output/particle_output.hpp"
#include "dem_solver/scene/build_model.hpp"
#include "dem_solver/scene/effects.hpp"
#include "dem_solver/scene/step_limits.hpp"

namespace talus::dem {

/// A scene as the particle side reads it.
struct RunScene {
  core::TimeScene time;
  std::optional<core::OutputScene> output;
  ParticlesScene particles;
};
/// @throws ConfigError with all complaints
RunScene read_run_scene(const core::SceneFile& file);

/// Solver and output of one run, standalone or coupled.
struct ParticleRun {
  ParticleSolver solver;
  std::unique_ptr<core::StageClock> clock;  ///< nullptr: the scene does not ask for stage times
  ParticleOutput output;
  std::vector<ParticleStepLimit> limits;

  /// @param surface the whole boundary; `node_masses` empty: no structure moves it
  ParticleRun(const RunScene& scene, const mesh::Surface& surface, std::span<const double> node_masses);
  ParticleRun(const ParticleRun&) = delete;  // the output refers to the solver
  ParticleRun& operator=(const ParticleRun&) = delete;

 private:
  ParticleRun(const RunScene& scene, const ParticleModel& model, std::span<const double> node_masses);
};

/// s; particles.step or else time.step. A coupled run may name neither: it then follows the coupler's
/// windows.
std::optional<double> own_step(const RunScene& scene);

/// The Markdown of the sections this program reads.
std::string schema();

}  // namespace talus::dem
