#include "core/errors.hpp"

#include <fmt/format.h>

#include <new>
#include <system_error>

namespace talus::core {
namespace {

std::string joined(const std::vector<Complaint>& complaints) {
  std::string text;
  for (const auto& complaint : complaints) text += (text.empty() ? "" : "\n") + complaint.text();
  return text;
}

std::string sentence(const TransportError::Details& d) {
  return fmt::format("{} {} while {} waited for {}{}", d.peer, d.reason, d.waiter, d.waited_for,
                     d.window < 0 ? " before the first window" : fmt::format(" in window {}", d.window));
}

std::string sentence(const NumericalError::Details& d) {
  const std::string step = d.step < 0 ? "" : fmt::format("step {}, ", d.step);
  std::string last;
  if (d.last_output_time)
    last = *d.last_output_time < 0
               ? "; no output was written before"
               : fmt::format("; the last good output is at {:.9g} s", *d.last_output_time);
  return fmt::format("{} at {}time {:.9g} s: {} = {:.6g}{}", d.what, step, d.time, d.entity, d.value, last);
}

}  // namespace

std::string Complaint::text() const {
  std::string where = file;
  if (line > 0) where += fmt::format(":{}", line);
  if (line > 0 && column > 0) where += fmt::format(":{}", column);
  if (!key_path.empty()) where += (where.empty() ? "" : ": ") + key_path;
  return where.empty() ? message : where + ": " + message;
}

ConfigError::ConfigError(std::vector<Complaint> complaints)
    : std::runtime_error(joined(complaints)), complaints_(std::move(complaints)) {}
ConfigError::ConfigError(const std::string& message)
    : ConfigError(std::vector<Complaint>{{.message = message}}) {}

TransportError::TransportError(Details details)
    : std::runtime_error(sentence(details)), details_(std::move(details)) {}

NumericalError::NumericalError(Details details)
    : std::runtime_error(sentence(details)), details_(std::move(details)) {}

FileError::FileError(const std::filesystem::path& path, const std::string& action, int error)
    : MachineError(fmt::format("'{}' cannot be {}: {}", path.string(), action,
                               std::generic_category().message(error))) {}

std::string exit_code_help() {
  return "Exit codes:\n"
         "  0  done\n"
         "  1  an error nobody expected\n"
         "  2  the scene or the command line is wrong\n"
         "  3  a solver or the coupler died, hangs, or does not fit the other\n"
         "  4  the computation broke down: not finite, not converged\n"
         "  5  stopped by Ctrl-C, SIGTERM, SIGHUP, SIGUSR1 or SIGUSR2; everything so far is written\n"
         "  6  a regression or study found a difference\n"
         "  7  the machine: disk full or read-only, no permission, too little memory or shared memory";
}

ExitCode exit_code(const std::exception& error) noexcept {
  if (dynamic_cast<const ConfigError*>(&error)) return ExitCode::config;
  if (dynamic_cast<const TransportError*>(&error)) return ExitCode::transport;
  if (dynamic_cast<const NumericalError*>(&error)) return ExitCode::numerical;
  if (dynamic_cast<const MachineError*>(&error) || dynamic_cast<const std::bad_alloc*>(&error) ||
      dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return ExitCode::machine;
  return ExitCode::bug;
}

}  // namespace talus::core
