#include "coupler/study/fingerprint.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/input_file.hpp"
#include "core/scene/reader.hpp"
#include "coupler/launch/find_solver.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Programs of other people's that the scene takes from beside talus or from PATH.
std::vector<fs::path> solvers_of(const core::SceneFile& scene) {
  std::vector<fs::path> found;
  for (const char* key : {"structure.solver.program", "particles.solver.program"}) {
    const fs::path written = scene.path_at(key);
    if (written.empty()) continue;
    if (const auto program = coupler::launch::named_solver(written.filename(), written))
      found.emplace_back(program->command.back());
  }
  return found;
}

std::string changed_file(const json& before, const json& now) {
  for (const auto* files : {&now, &before})
    for (const auto& [name, digest] : files->items())
      if (before.value(name, "") != now.value(name, ""))
        return fs::path(name).filename().string() + " changed";
  return {};
}

}  // namespace

Fingerprints::Fingerprints(const fs::path& program, fs::path folder, int threads)
    : folder_(std::move(folder)), threads_(threads) {
  for (const char* name : {"fem_solver", "dem_solver"})
    programs_ += core::digest_of_content(program.parent_path() / name) + " ";
  programs_ += core::digest_of_content(program);
}

const std::string& Fingerprints::digest_of(const fs::path& file) {
  std::string& digest = digests_[file];
  if (digest.empty()) digest = core::digest_of_content(file);
  return digest;
}

json Fingerprints::files_of(const core::SceneFile& scene) {
  json files = json::object();
  auto named = scene.named_files();
  const auto solvers = solvers_of(scene);
  named.insert(named.end(), solvers.begin(), solvers.end());
  for (const auto& file : named) files[fs::proximate(file, folder_).string()] = digest_of(file);
  return files;
}

json Fingerprints::of(const PlannedRun& run) {
  const auto scene = core::SceneFile::parse(run.scene, folder_ / run.id / "scene.yaml");
  return {
      {"scene", scene.hash()}, {"files", files_of(scene)}, {"programs", programs_}, {"threads", threads_}};
}

std::string difference(const json& before, const json& now) {
  if (before == now) return {};
  if (before.value("scene", "") != now.at("scene")) return "its scene changed";
  const std::string file = changed_file(before.value("files", json::object()), now.at("files"));
  if (!file.empty()) return file;
  if (before.value("programs", "") != now.at("programs")) return "the programs were built anew";
  return "the number of threads changed";
}

bool is_same_scene(const json& before, const json& now) {
  return before.value("scene", "") == now.at("scene") && before.value("files", json()) == now.at("files");
}

}  // namespace talus::study
