#include "core/program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace talus::core {
namespace {

/// Simulated seconds a second of wall time.
double real_time_factor(const ProgressState& state, double wall) {
  return wall > 0 ? state.time / wall : 0;
}

/// Seconds of wall time to the end, at the mean speed so far.
double seconds_left(const ProgressState& state, double wall) {
  return state.time > 0 ? std::max(0.0, (state.end - state.time) / state.time * wall) : 0;
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string progress_line(const ProgressState& state, const std::string& unit, double wall) {
  std::string line =
      fmt::format("{:.4g} / {:.4g} s  {} {}  {:.3g} x real time  energy error {:.1e}", state.time, state.end,
                  state.steps, unit, real_time_factor(state, wall), state.energy_error);
  if (!state.limit.empty()) line += "  limited by " + state.limit;
  if (state.time > 0 && state.time < state.end) line += "  " + duration(seconds_left(state, wall)) + " left";
  return line;
}

std::string progress_json(const ProgressState& state, const std::string& unit, double wall) {
  nlohmann::json json{{"time_s", state.time},
                      {"end_s", state.end},
                      {unit, state.steps},
                      {"wall_time_s", wall},
                      {"real_time_factor", real_time_factor(state, wall)},
                      {"energy_error_relative", state.energy_error},
                      {"seconds_left", seconds_left(state, wall)}};
  if (!state.limit.empty()) json["limited_by"] = state.limit;
  return json.dump();
}

Progress::Progress(ProgressStyle style, std::string unit, std::FILE* stream)
    : style_(style), unit_(std::move(unit)), stream_(stream) {
  if (style_ == ProgressStyle::automatic)
    style_ = isatty(fileno(stream)) ? ProgressStyle::line : ProgressStyle::rare;
}

double Progress::wall() const {
  return std::chrono::duration<double>(Clock::now() - started_).count();
}

bool Progress::is_due(const ProgressState& state) const {
  const auto since = Clock::now() - shown_;
  if (style_ == ProgressStyle::rare)
    return state.time >= next_share_ * state.end && since >= std::chrono::seconds(1);
  return since >= std::chrono::milliseconds(style_ == ProgressStyle::line ? 100 : 1000);
}

void Progress::update(const ProgressState& state) {
  if (style_ != ProgressStyle::quiet && is_due(state)) show(state);
}

void Progress::finish(const ProgressState& state) {
  if (style_ == ProgressStyle::quiet) return;
  show(state);
  if (style_ == ProgressStyle::line) std::fputc('\n', stream_);
}

/// A terminal that was closed, or a pipe whose reader left, is no reason to end a run.
void Progress::print(const std::string& text) {
  std::fputs(text.c_str(), stream_);
  std::fflush(stream_);
}

void Progress::note(const std::string& text) {
  if (style_ == ProgressStyle::quiet) return;
  show_line(style_ == ProgressStyle::json ? nlohmann::json{{"note", text}}.dump() : text);
}

void Progress::show(const ProgressState& state) {
  show_line(style_ == ProgressStyle::json ? progress_json(state, unit_, wall())
                                          : progress_line(state, unit_, wall()));
  shown_ = Clock::now();
  while (next_share_ * state.end <= state.time && next_share_ < 1) next_share_ += 0.1;
}

void Progress::show_line(std::string line) {
  if (style_ == ProgressStyle::line) {
    const std::size_t length = line.size();
    if (length < width_) line.append(width_ - length, ' ');  // wipes what is left of a longer line before
    width_ = length;
    print("\r" + line);
  } else {
    print(line + "\n");
  }
}

}  // namespace talus::core
