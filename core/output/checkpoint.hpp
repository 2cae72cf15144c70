#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"
#include "core/output/memory_file.hpp"

namespace talus::core {

/// A state as its named numbers: the same list of calls writes it to a file and reads it back, bit for bit.
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  virtual void values(const std::string& name, std::vector<double>& values) = 0;
  virtual void count(const std::string& name, std::int64_t& count) = 0;
};

/// Writes a state to an HDF5 file, one dataset a name, in whole or not at all: it is made in memory, then
/// written to a file beside it that takes its place in commit().
class CheckpointWriter final : public StateArchive {
 public:
  /// @param owner who the state belongs to, e.g. "fem_solver explicit"; checked when it is read
  CheckpointWriter(std::filesystem::path path, const std::string& owner);
  ~CheckpointWriter() override;
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  void values(const std::string& name, std::vector<double>& values) override;
  void count(const std::string& name, std::int64_t& count) override;
  /// Records of any kind, as this machine holds them.
  void bytes(const std::string& name, std::span<const std::byte> bytes);
  void text(const std::string& name, const std::string& text);
  /// How the checkpoint takes its place.
  struct Place {
    Durability durability = Durability::kill;
    std::filesystem::path before = {};  ///< where the one that was there goes; empty: it is replaced
  };
  /// @throws FileError where the file system refuses; what was there is then still there
  void commit(const Place& place);
  void commit() { commit(Place{}); }

 private:
  void write(const std::string& name, std::int64_t type, const void* data, std::size_t size);
  std::filesystem::path path_;
  MemoryFile memory_{"checkpoint"};
  std::int64_t file_ = -1;
};

/// Reads a state. Arrays keep the size they have: a state of another size is an error.
class CheckpointReader final : public StateArchive {
 public:
  /// @throws ConfigError where the file is missing, no checkpoint, or of another owner
  CheckpointReader(const std::filesystem::path& path, const std::string& owner)
      : CheckpointReader(path, std::vector<std::string>{owner}) {}
  /// One of several.
  CheckpointReader(const std::filesystem::path& path, const std::vector<std::string>& owners);
  ~CheckpointReader() override;
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  /// @throws ConfigError where the name is missing or the size is another
  void values(const std::string& name, std::vector<double>& values) override;
  void count(const std::string& name, std::int64_t& count) override;
  /// As many as were written. @throws ConfigError where the name is missing
  std::vector<std::byte> bytes(const std::string& name);
  /// Nothing where the name is missing.
  std::optional<std::string> text(const std::string& name);

 private:
  void read(const std::string& name, std::int64_t type, void* data, std::size_t size);
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace talus::core
