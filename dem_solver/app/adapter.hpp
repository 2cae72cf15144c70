#pragma once

#include "core/scene/reader.hpp"
#include "coupler/participant.hpp"

namespace talus::dem {

/// The particle side's life in a coupled run: receives Ω_D, declares itself and answers commands until
/// `finish`. An error is told to the coupler before it is thrown on.
/// @throws ConfigError, TransportError, NumericalError
void serve_particles(const core::SceneFile& file, coupler::Participant& participant);

}  // namespace talus::dem
