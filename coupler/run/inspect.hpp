#pragma once

#include <filesystem>

#include "core/errors.hpp"

/// Commands that look at a scene without computing it: a run of no windows. They start no program that the
/// scene names, unless they are told to trust it: looking at a scene of somebody else must not run his programs.
namespace talus::coupler {

struct InspectRequest {
  std::filesystem::path scene;
  bool trust = false;  ///< programs that the scene names are started and asked
};

/// Prints the step limits of both sides, tightest first. @returns ExitCode::config where a run would be
/// refused
core::ExitCode check_scene(const InspectRequest& request);
/// Prints the effects of both sides, in or out, with reasons.
core::ExitCode explain_scene(const InspectRequest& request);
/// Prints the schema page: the sections of the coupler, then those of each solver, printed by the solver
/// itself.
core::ExitCode print_schema();

}  // namespace talus::coupler
