#pragma once

#include <string>
#include <vector>

#include "dem_solver/scene/particles_scene.hpp"

namespace talus::dem {

/// An effect of the particle side, as `talus explain` lists it.
struct ParticleEffect {
  std::string name;
  bool present = false;
  std::string reason;
};

/// Which effects the scene calls for and why; of the absent ones, what the scene would have to name.
struct EffectContext {
  bool has_interface = false;  ///< the scene has an `interface`
  bool has_output = false;     ///< the scene has an `output`
};
std::vector<ParticleEffect> effects_of(const ParticlesScene& particles, const EffectContext& context);

}  // namespace talus::dem
