#include "core/program/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/ringbuffer_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "core/errors.hpp"
#include "core/output/file.hpp"

namespace talus::core {
namespace {

constexpr const char* shown_pattern = "%^%l%$: %v";
constexpr const char* file_pattern = "%Y-%m-%dT%H:%M:%S.%e %l %v";
constexpr std::size_t kept_messages = 1000;

spdlog::level::level_enum spdlog_level(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

class Log {
 public:
  Log() {
    shown_->set_pattern(shown_pattern);
    shown_->set_level(spdlog::level::info);
    early_->set_pattern(file_pattern);
    early_->set_level(spdlog::level::info);
  }
  void show_from(LogLevel level) { shown_->set_level(spdlog_level(level)); }
  void write(LogLevel level, const std::string& message) {
    const std::lock_guard lock(mutex_);
    write(*shown_, {"talus", spdlog_level(level), message});
    keep(level, message);
  }
  void note(LogLevel level, const std::string& message) {
    const std::lock_guard lock(mutex_);
    keep(level, message);
  }
  std::vector<std::string> warnings() {
    const std::lock_guard lock(mutex_);
    return warnings_;
  }
  void open(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    std::string before;
    for (const auto& line : early_->last_formatted()) before += line;
    replace_file(path, before);
    try {
      file_ = std::make_unique<spdlog::sinks::basic_file_sink_mt>(path.string(), false);
    } catch (const spdlog::spdlog_ex& error) {
      throw FileError(error.what());
    }
    file_->set_pattern(file_pattern);
    file_->set_level(spdlog::level::info);
  }

 private:
  void keep(LogLevel level, const std::string& message) {
    if (level == LogLevel::warning && warnings_.size() < kept_messages &&
        std::ranges::find(warnings_, message) == warnings_.end())
      warnings_.push_back(message);
    const spdlog::details::log_msg entry("talus", spdlog_level(level), message);
    if (!write(file_ ? static_cast<spdlog::sinks::sink&>(*file_) : *early_, entry)) file_.reset();
  }
  /// False where it cannot be written: a full disk must not keep a message from the screen, nor a terminal
  /// that is gone end a run.
  static bool write(spdlog::sinks::sink& sink, const spdlog::details::log_msg& entry) noexcept {
    try {
      if (sink.should_log(entry.level)) sink.log(entry), sink.flush();
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  std::mutex mutex_;
  std::unique_ptr<spdlog::sinks::stderr_color_sink_mt> shown_ =
      std::make_unique<spdlog::sinks::stderr_color_sink_mt>();
  std::unique_ptr<spdlog::sinks::ringbuffer_sink_mt> early_ =
      std::make_unique<spdlog::sinks::ringbuffer_sink_mt>(kept_messages);
  std::unique_ptr<spdlog::sinks::basic_file_sink_mt> file_;
  std::vector<std::string> warnings_;
};

Log& the_log() {
  static Log log;
  return log;
}

}  // namespace

void show_log_from(LogLevel level) {
  the_log().show_from(level);
}
void open_log_file(const std::filesystem::path& path) {
  the_log().open(path);
}
void log(LogLevel level, const std::string& message) {
  the_log().write(level, message);
}
void note_warning(const std::string& message) {
  the_log().note(LogLevel::warning, message);
}
std::vector<std::string> warnings_said() {
  return the_log().warnings();
}

}  // namespace talus::core
