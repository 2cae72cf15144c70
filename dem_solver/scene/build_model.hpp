#pragma once

#include <string>
#include <vector>

#include "core/scene/sections.hpp"
#include "dem_solver/scene/particles_scene.hpp"
#include "dem_solver/solver.hpp"

/// From a scene to what the solver computes with.
namespace talus::dem {

/// What the section `particles` does not say itself.
struct BuildContext {
  double step = 0;      ///< s
  bool ledger = false;  ///< the run writes energies
  int threads = 1;
  bool moved_by_structure = false;  ///< the boundary, or a part of it
};

/// @pre the scene was read without complaints
LawChoice law_of(const ParticlesScene& particles, const BuildContext& context);

/// In the order of the scene.
std::vector<Material> materials_of(const ParticlesScene& particles);

/// @param surface the boundary: make_surface() of the scene, or the one received from the coupler.
/// @throws ConfigError where the boundary's material is unknown or has no contact with a sphere's.
ParticleModel build_model(const ParticlesScene& particles, const mesh::Surface& surface,
                          const BuildContext& context);

}  // namespace talus::dem
