#include "core/output/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/program/log.hpp"

namespace talus::core {
namespace fs = std::filesystem;

const std::vector<std::string>& ResultFolder::file_names() {
  static const std::vector<std::string> names{
      "summary.json",  "probes.csv",           "energy.csv", "fields.h5",   "fields.xdmf",
      "checkpoint.h5", "checkpoint_before.h5", "log.txt",    "report.html", state_file()};
  return names;
}

bool ResultFolder::is_unfinished(const std::string& name) {
  const auto parts_of = [&](const std::string& file) {
    return name.starts_with(file) && name.ends_with(Replacement::temporary_of("").string());
  };
  return parts_of("checkpoint_of_") || parts_of("reserve") || std::ranges::any_of(file_names(), parts_of);
}

namespace {

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (fs::is_directory(path)) return;
  if (error && error != std::errc::not_a_directory && error != std::errc::file_exists)
    throw FileError(path, "made a result folder", error.value());
  throw ConfigError("'" + path.string() + "' cannot be made a result folder: something there is no folder");
}

/// A lock on the folder itself, which the system drops when the process ends, however it ends.
int locked(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw FileError(path, "opened as a result folder", errno);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  if (errno != EWOULDBLOCK) {
    log_warning("the file system of '" + path.string() + "' knows no locks: no other run may write there");
    return descriptor;
  }
  ::close(descriptor);
  throw ConfigError("another run is writing to '" + path.string() + "'; choose another folder with --out");
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw FileError(path, "removed", error.value());
}

bool holds_something(const fs::path& path) {
  return std::ranges::any_of(fs::directory_iterator(path), [](const fs::directory_entry& entry) {
    return !ResultFolder::is_unfinished(entry.path().filename());
  });
}

void remove_unfinished(const fs::path& path) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path))
    if (ResultFolder::is_unfinished(entry.path().filename())) found.push_back(entry.path());
  for (const auto& file : found) remove_file(file);
}

/// The files of an earlier result's tables; none where its summary cannot be read.
std::vector<std::string> table_files(const fs::path& path) {
  std::vector<std::string> names;
  std::ifstream file(path / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  if (!summary.is_object() || !summary.contains("tables")) return names;
  for (const auto& [name, table] : summary["tables"].items())
    if (fs::path(name).filename() == name) names.push_back(ResultFolder::table_file(name));
  return names;
}

void remove_result(const fs::path& path) {
  for (const auto& name : table_files(path)) remove_file(path / name);
  for (const auto& name : ResultFolder::file_names()) remove_file(path / name);
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& path, Existing existing) : path_(path) {
  make_folder(path);
  if (existing == Existing::refuse && holds_something(path))
    throw ConfigError("'" + path.string() +
                      "' is not empty; --overwrite replaces an earlier result, --out chooses another folder");
  lock_ = locked(path);
  if (existing == Existing::replace) remove_result(path);
  remove_unfinished(path);
}

ResultFolder::~ResultFolder() {
  ::close(lock_);
}

}  // namespace talus::core
