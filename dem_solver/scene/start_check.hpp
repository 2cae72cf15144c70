#pragma once

#include "dem_solver/scene/build_model.hpp"

namespace talus::dem {

/// @throws ConfigError where a sphere or rock starts inside of a plane, a wire or a face, or below terrain: it would
/// be thrown out, or fall for ever. Names each body, its partner and the depth.
///
/// A start at rest is allowed: an overlap of 2 % of the radius (of a rock: of its largest sphere), or, where that is
/// more, the one at which the contact's spring bears the body's weight, up to 10 % of the radius.
///
/// Below terrain is a centre under a `height_grid`; and, where gravity acts, under faces of a boundary at rest that
/// are flatter than 60 degrees, with nothing below it, and not on its way up.
/// @param surface the boundary the model was built with
void check_start(const ParticlesScene& particles, const ParticleModel& model, const mesh::Surface& surface);

}  // namespace talus::dem
