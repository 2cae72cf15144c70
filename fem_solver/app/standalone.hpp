#pragma once

#include "core/program/command_line.hpp"

namespace talus::fem {

/// Runs the structural part of a scene on its own and writes its result folder.
core::ExitCode run_standalone(const core::SolverCommand& command);

}  // namespace talus::fem
