#pragma once

#include <filesystem>
#include <string>

#include "core/output/file.hpp"

namespace talus::core {

/// A file in memory, for a library that writes files by itself and does not survive a full disk: the HDF5
/// library then runs in circles or crashes when it closes. It writes here, and what it wrote is copied by
/// those who know how to fail.
class MemoryFile {
 public:
  /// @param name for messages and /proc. @throws MachineError where the system gives none
  explicit MemoryFile(const std::string& name);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// A path for this process, valid as long as this lives.
  std::filesystem::path path() const;
  /// Everything, holes as holes. @throws FileError
  void copy_to(OutputFile& file) const;

 private:
  int descriptor_;
};

}  // namespace talus::core
