#include "coupler/session/patience.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::coupler {
namespace {

constexpr double sampled_from = 0.25;      // s into a wait
constexpr double least_share = 0.05;       // of a core; a process that only looks around uses less
constexpr double shortest_measured = 0.5;  // s; the kernel counts in ticks of 10 ms

}  // namespace

void Patience::look(pid_t pid, double seconds) {
  if (seconds < seconds_ || pid != pid_) *this = {};
  pid_ = pid;
  seconds_ = seconds;
  if (begin_ || pid <= 0 || seconds < sampled_from) return;
  if (const auto activity = transport::activity_of(pid)) begin_ = {seconds, activity->cpu_time};
}

bool Patience::time_to_tell() {
  if (seconds_ < next_told_) return false;
  next_told_ *= 2;
  return true;
}

std::string Patience::condition() const {
  using State = transport::ProcessActivity::State;
  const auto activity = pid_ > 0 ? transport::activity_of(pid_) : std::nullopt;
  if (!activity) return "";
  if (activity->state == State::stopped) return "is stopped";
  if (activity->state == State::gone) return "is gone";
  const bool waits_for_disk = activity->state == State::waits_for_disk;
  if (!begin_ || seconds_ - begin_->seconds < shortest_measured)
    return activity->state == State::runs ? "runs" : waits_for_disk ? "waits for a disk" : "sleeps";
  const double share = (activity->cpu_time - begin_->cpu_time) / (seconds_ - begin_->seconds);
  const auto percent = fmt::format("{:.0f} % CPU", 100 * std::max(0.0, share));
  if (share >= least_share) return "computing, " + percent;
  return (waits_for_disk ? "stuck: waits for a disk, " : "stuck: sleeps, ") + percent;
}

}  // namespace talus::coupler
