#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// Reads fields.h5 back, also that of a run that was killed: complete frames only.
class FieldReader {
 public:
  /// @throws std::runtime_error where the file is missing or no result of Talus
  explicit FieldReader(const std::filesystem::path& path);
  ~FieldReader();

  std::int64_t frames() const { return static_cast<std::int64_t>(times_.size()); }
  const std::vector<double>& times() const { return times_; }  ///< s; one a frame
  /// The groups in the order of their names, with their cells; of a group's fields, name, unit and
  /// components.
  const std::vector<GroupDescription>& groups() const { return groups_; }

  /// @param series "position" or the name of a field. @return rows x components, of one frame
  std::vector<double> read(const GroupDescription& group, const std::string& series,
                           std::int64_t frame) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
  std::vector<double> times_;
  std::vector<GroupDescription> groups_;
};

}  // namespace talus::core
