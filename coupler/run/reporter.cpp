#include "coupler/run/reporter.hpp"

#include <algorithm>

#include "core/program/log.hpp"
#include "coupler/schemes/commands.hpp"

namespace talus::coupler {

Reporter::Reporter(Session& session, core::ResultWriter& results, Plan plan, core::ProgressStyle style)
    : session_(session), results_(results), plan_(std::move(plan)), progress_(style, "windows") {
  session_.tell_waits_to([this](const std::string& text) { progress_.note(text); });
}

Reporter::~Reporter() {
  session_.tell_waits_to(core::log_info);
}

core::ProgressState Reporter::state(std::int64_t window) const {
  return {.time = static_cast<double>(window) * plan_.span.window_length,
          .end = plan_.span.end,
          .steps = window,
          .energy_error = results_.balance().last().error_relative,
          .limit = plan_.limited_by};
}

void Reporter::begin_at(std::int64_t window) {
  plan_.rows.done(window - 1);
  if (plan_.frames) plan_.frames->done(window - 1);
}

void Reporter::at(std::int64_t window) {
  const bool frame = plan_.frames && plan_.frames->due(window);
  if (frame || plan_.rows.due(window)) write(window, frame);
  progress_.update(state(window));
}

std::int64_t Reporter::next_due() const {
  const std::int64_t row = plan_.rows.next();
  return plan_.frames ? std::min(row, plan_.frames->next()) : row;
}

void Reporter::last(std::int64_t window) {
  if (written_ < window) write(window, plan_.frames.has_value());
  progress_.finish(state(window));
}

void Reporter::write(std::int64_t window, bool frame) {
  Command report = command_at(plan_.span.window(window), Action::report);
  report.fields = frame;
  session_.ask_all(report);
  results_.write_row(report.time);
  if (frame) results_.write_fields(report.time);
  plan_.rows.done(window);
  if (plan_.frames) plan_.frames->done(window);
  written_ = window;
}

}  // namespace talus::coupler
