#pragma once

#include "core/program/command_line.hpp"
#include "core/scene/reader.hpp"
#include "coupler/participant.hpp"

namespace talus::fem {

/// A structure's whole coupled life: publishes the parts that `interface.structure` names, with their node
/// masses, then answers the coupler's commands until it says finish.
/// @throws core::ConfigError, core::NumericalError after having told the coupler; core::TransportError where
/// the coupler is gone
void serve_structure(const core::SceneFile& file, coupler::Participant& participant);

/// Joins the run that the command line names and serves it.
core::ExitCode run_coupled(const core::SolverCommand& command);

}  // namespace talus::fem
