#pragma once

#include <string>
#include <vector>

#include "dem_solver/scene/particles_scene.hpp"

namespace talus::dem {

/// Complains about names that nothing defines, pairs of materials that can meet but have no contact law, and
/// laws that don't go together.
void check_references(core::Fields& fields, const ParticlesScene& particles);

/// A named thing of the scene that moves, and how many of it can meet each other.
struct Body {
  const char* section;  ///< "spheres", "rocks" or "streams"
  std::string name, material;
  std::int64_t count = 1;
};
std::vector<Body> bodies_of(const ParticlesScene& particles);

/// The place of a name in `materials`, -1 where it is none.
std::int64_t material_index(const ParticlesScene& particles, const std::string& name);

/// The contact entry of two materials in either order; nullptr where there is none.
const ContactScene* find_contact(const ParticlesScene& particles, const std::string& a, const std::string& b);

/// "no contact between `rock` and `wire`: add an entry with `between: [rock, wire]` to particles.contacts"
std::string missing_contact_message(const std::string& a, const std::string& b);

}  // namespace talus::dem
