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
  std::string key = {};          ///< that names it; empty where it has none of its own
  std::string ledger_line = {};  ///< whose energy appears where it acts
  bool may_hold = false;         ///< it may act without doing work, as friction that holds a block
  std::string limit = {};        ///< step limit that is not there where the scene names it
};

/// Which effects the scene calls for and why; of the absent ones, what the scene would have to name.
struct EffectContext {
  bool has_interface = false;  ///< the scene has an `interface`
  bool has_output = false;     ///< the scene has an `output`
};
std::vector<ParticleEffect> effects_of(const ParticlesScene& particles, const EffectContext& context);

}  // namespace talus::dem
