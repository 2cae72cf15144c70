#include "coupler/launch/find_solver.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "core/errors.hpp"

namespace talus::coupler::launch {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders_of_path() {
  const char* variable = std::getenv("PATH");
  std::istringstream folders(variable == nullptr ? "" : variable);
  std::vector<fs::path> all;
  for (std::string folder; std::getline(folders, folder, ':');) all.emplace_back(folder);
  return all;
}

bool is_python(const fs::path& file) {
  return file.extension() == ".py";
}

bool can_be_started(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && (is_python(file) || access(file.c_str(), X_OK) == 0);
}

/// The folder of the package `talus_participant`: of a build, of an installation, or of one seen from its programs for
/// newer processors (core/program/faster_build.hpp).
fs::path package_folder() {
  const fs::path above = program_folder().parent_path();
  const fs::path installed = above / TALUS_PYTHON_PACKAGES,
                 from_faster = above / "../../.." / TALUS_PYTHON_PACKAGES;
  for (const auto& folder : {installed, from_faster})
    if (fs::exists(folder / "talus_participant")) return folder;
  return above / "python";
}

std::vector<std::string> python_command(const fs::path& file) {
  std::string search = "PYTHONPATH=" + package_folder().string();
  if (const char* of_the_user = std::getenv("PYTHONPATH")) search += std::string(":") + of_the_user;
  return {"/usr/bin/env", search, TALUS_PYTHON, file.string()};
}

}  // namespace

fs::path program_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

fs::path own_solver(const std::string& name) {
  const fs::path file = program_folder() / name;
  if (!can_be_started(file))
    throw core::ConfigError("the program " + file.string() + " is missing; build it first");
  return file;
}

std::optional<Program> named_solver(const std::string& written, const fs::path& relative_to_scene) {
  std::vector<fs::path> candidates{relative_to_scene, program_folder() / written};
  if (written.find('/') == std::string::npos) {
    for (const auto& folder : folders_of_path()) candidates.push_back(folder / written);
  }
  for (const auto& file : candidates) {
    if (!can_be_started(file)) continue;
    std::vector<std::string> command{file.string()};
    if (is_python(file)) command = python_command(file);
    return Program{
        .name = file.filename(), .command = std::move(command), .file = fs::weakly_canonical(file)};
  }
  return std::nullopt;
}

std::optional<fs::path> on_path(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return access(name.c_str(), X_OK) == 0 ? std::optional<fs::path>(name) : std::nullopt;
  for (const auto& folder : folders_of_path())
    if (access((folder / name).c_str(), X_OK) == 0) return folder / name;
  return std::nullopt;
}

}  // namespace talus::coupler::launch
