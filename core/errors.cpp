#include "core/errors.hpp"

#include <fmt/format.h>

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
  const std::string last = d.last_output_time < 0
                               ? "no output was written before"
                               : fmt::format("the last good output is at {:.9g} s", d.last_output_time);
  return fmt::format("{} at {}time {:.9g} s: {} = {:.6g}; {}", d.what, step, d.time, d.entity, d.value, last);
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

ExitCode exit_code(const std::exception& error) noexcept {
  if (dynamic_cast<const ConfigError*>(&error)) return ExitCode::config;
  if (dynamic_cast<const TransportError*>(&error)) return ExitCode::transport;
  if (dynamic_cast<const NumericalError*>(&error)) return ExitCode::numerical;
  return ExitCode::bug;
}

}  // namespace talus::core
