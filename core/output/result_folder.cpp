#include "core/output/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"

namespace talus::core {
namespace fs = std::filesystem;

const std::vector<std::string>& ResultFolder::file_names() {
  static const std::vector<std::string> names{"summary.json", "probes.csv",    "energy.csv", "fields.h5",
                                              "fields.xdmf",  "checkpoint.h5", "log.txt",    "report.html"};
  return names;
}

namespace {

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path))
    throw ConfigError("'" + path.string() + "' cannot be made a result folder" +
                      (error ? ": " + error.message() : ""));
}

/// A lock on the folder itself, which the system drops when the process ends, however it ends.
int locked(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (descriptor >= 0) ::close(descriptor);
    throw ConfigError("another run is writing to '" + path.string() + "'; choose another folder with --out");
  }
  return descriptor;
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
  for (const auto& name : table_files(path)) fs::remove(path / name);
  for (const auto& name : ResultFolder::file_names()) {
    fs::remove(path / name);
    fs::remove(path / (name + ".part"));
  }
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& path, Existing existing) : path_(path) {
  make_folder(path);
  if (existing == Existing::refuse && !fs::is_empty(path))
    throw ConfigError("'" + path.string() +
                      "' is not empty; --overwrite replaces an earlier result, --out chooses another folder");
  lock_ = locked(path);
  if (existing == Existing::replace) remove_result(path);
}

ResultFolder::~ResultFolder() {
  ::close(lock_);
}

}  // namespace talus::core
