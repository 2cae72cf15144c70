#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

/// Files written so that a reader finds them whole although the writer may be killed at any moment.
namespace talus::core {

/// An open file of its own, closed at the end of its life. Errors of the system are std::system_error with
/// the path.
class OutputFile {
 public:
  enum class Mode { create, append, update };
  OutputFile(const std::filesystem::path& path, Mode mode);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// At the end, in one call of the system, so that a kill leaves all of `text` or nothing (but for one that
  /// falls between two pages).
  void append(const std::string& text);
  /// At a byte offset; leaves a hole where the file is shorter.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);

 private:
  [[noreturn]] void fail(const char* action) const;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Replaces the content in one step: a reader sees the old text or the new one, never a part.
void replace_file(const std::filesystem::path& path, const std::string& text);

}  // namespace talus::core
