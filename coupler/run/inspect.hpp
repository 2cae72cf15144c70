#pragma once

#include <filesystem>

#include "core/errors.hpp"

/// Commands that look at a scene without computing it: a run of no windows.
namespace talus::coupler {

/// Prints the step limits of both sides, tightest first. @returns ExitCode::config where a run would be
/// refused
core::ExitCode check_scene(const std::filesystem::path& scene);
/// Prints the effects of both sides, in or out, with reasons.
core::ExitCode explain_scene(const std::filesystem::path& scene);
/// Prints the schema page: the sections of the coupler, then those of each solver, printed by the solver
/// itself.
core::ExitCode print_schema();

}  // namespace talus::coupler
