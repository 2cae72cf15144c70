#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "coupler/launch/child.hpp"

namespace talus::coupler::launch {

/// The folder of the running program.
std::filesystem::path program_folder();

/// A program of Talus itself, which stands beside the running one. @throws core::ConfigError where it is not
/// there
std::filesystem::path own_solver(const std::string& name);

/// A solver a scene names: absolute, else relative to the scene, else beside the running program, else on
/// PATH. A Python file is run by the Python that the package `talus_participant` was built for, which it finds on its
/// path. Looks only; nothing is started.
/// @returns nothing where there is no such program
std::optional<Program> named_solver(const std::string& written,
                                    const std::filesystem::path& relative_to_scene);

/// A program as a shell finds it. @returns nothing where it is not on PATH, or cannot be started
std::optional<std::filesystem::path> on_path(const std::string& name);

}  // namespace talus::coupler::launch
