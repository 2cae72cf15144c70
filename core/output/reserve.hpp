#pragma once

#include <filesystem>

namespace talus::core {

/// Some room on the disk of a result, taken at the start and given back before its last words are written, so
/// that a run which ends because the disk is full can say so in its summary.
class Reserve {
 public:
  /// Where there is no room even for this, there is none to give back.
  explicit Reserve(const std::filesystem::path& folder) noexcept;
  ~Reserve() { release(); }
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;

  /// Idempotent.
  void release() noexcept;

 private:
  std::filesystem::path path_;
};

}  // namespace talus::core
