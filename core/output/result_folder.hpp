#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::core {

/// A folder that holds one result and belongs to one run as long as the run lives.
class ResultFolder {
 public:
  enum class Existing { refuse, replace };

  /// Makes the folder. `replace` removes the files of an earlier result, those of its tables included, and
  /// leaves all others alone. Unfinished files that a killed run left behind count as nothing and go.
  /// @throws ConfigError where something is there already (and may not be replaced), is no folder, or another
  /// run writes to it; FileError where the system refuses.
  ResultFolder(const std::filesystem::path& path, Existing existing);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The names of the files a result may consist of, besides those of its tables, which summary.json lists.
  static const std::vector<std::string>& file_names();
  /// Of the structure at the end of a run that asks for it.
  static const char* state_file() { return "structure_state.h5"; }
  /// Whether a file of this name is one that a run writes to before it takes its place.
  static bool is_unfinished(const std::string& name);
  static std::string table_file(const std::string& table) { return table + ".csv"; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace talus::core
