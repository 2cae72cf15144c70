#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

/// Files written so that a reader finds them whole although the writer may be killed at any moment. What the
/// system refuses is a FileError that names the path and the cause.
namespace talus::core {

/// An open file of its own.
class OutputFile {
 public:
  enum class Mode { create, append, update };
  OutputFile(const std::filesystem::path& path, Mode mode);
  ~OutputFile();  ///< closes it where close() did not, without a look at errors
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// At the end, in one call of the system, so that a kill leaves all of `text` or nothing (but for one that
  /// falls between two pages).
  void append(const std::string& text);
  /// At a byte offset; leaves a hole where the file is shorter.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Cuts it, or lengthens it by a hole.
  void resize(std::uint64_t bytes);
  /// Takes room on the disk for so many bytes, so that they can be freed when it is full.
  void reserve(std::uint64_t bytes);
  /// Waits until everything is on the disk.
  void synchronise();
  /// Some file systems say only here that there was no room. No other call may follow.
  void close();

 private:
  [[noreturn]] void fail(const char* action, int error) const;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// What the content of a replaced file survives.
enum class Durability {
  kill,        ///< the end of the program, however it ends
  power_loss,  ///< also that of the machine: the disk is waited for
};

/// A file that takes the place of the one at `path` in one step, in commit(); without it nothing is left.
class Replacement {
 public:
  explicit Replacement(std::filesystem::path path);
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  OutputFile& file() { return file_; }
  void commit(Durability durability);

  /// Where it lies until then; one that a kill left behind is written over.
  static std::filesystem::path temporary_of(const std::filesystem::path& path) {
    return path.string() + ".part";
  }

 private:
  std::filesystem::path path_;
  OutputFile file_;
  bool committed_ = false;
};

/// Replaces the content in one step: a reader sees the old text or the new one, never a part.
void replace_file(const std::filesystem::path& path, const std::string& text,
                  Durability durability = Durability::kill);

/// Gives a file another name, in place of what had it. @param durability power_loss: waits until the disk has
/// the new name
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to, Durability durability);

}  // namespace talus::core
