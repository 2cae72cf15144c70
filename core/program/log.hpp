#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Messages of a program: to the standard error stream, and to log.txt once a result folder is there. Safe to
/// call from several threads.
namespace talus::core {

enum class LogLevel { debug, info, warning, error };

/// What is shown on the standard error stream from here on; log.txt gets everything from `info` up.
void show_log_from(LogLevel level);
/// Opens log.txt. Messages from before are written to it first. @throws FileError where it cannot be
/// written; what cannot be written later is shown only
void open_log_file(const std::filesystem::path& path);
void log(LogLevel level, const std::string& message);
/// A warning that another process has shown already: into log.txt and warnings_said().
void note_warning(const std::string& message);
/// The different warnings of this process so far, the first thousand in their order: for the summary.
std::vector<std::string> warnings_said();

inline void log_debug(const std::string& message) {
  log(LogLevel::debug, message);
}
inline void log_info(const std::string& message) {
  log(LogLevel::info, message);
}
inline void log_warning(const std::string& message) {
  log(LogLevel::warning, message);
}
inline void log_error(const std::string& message) {
  log(LogLevel::error, message);
}

}  // namespace talus::core
