#pragma once

#include "core/program/command_line.hpp"

namespace talus::dem {

/// Runs the particle side of a scene alone, against planes and boundaries at rest or at constant velocity,
/// and writes its result.
/// @throws ConfigError, NumericalError
core::ExitCode run_standalone(const core::SolverCommand& command);

}  // namespace talus::dem
