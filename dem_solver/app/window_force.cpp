#include "dem_solver/app/window_force.hpp"

#include <algorithm>
#include <utility>

#include "core/output/checkpoint.hpp"

namespace talus::dem {

void WindowForce::begin(const Window& window, std::span<double> mean) {
  window_ = window;
  mean_ = mean;
  std::ranges::fill(mean_, 0.0);
  std::swap(rest_, next_rest_);
  std::swap(loaded_, next_loaded_);
  for (const std::size_t node : next_loaded_) std::fill_n(next_rest_.begin() + 3 * node, 3, 0.0);
  next_loaded_.clear();
  for (const std::size_t node : loaded_)
    for (std::size_t i = 3 * node; i < 3 * node + 3; ++i) mean_[i] = rest_[i] / window.length;
  work_ = std::exchange(next_work_, 0.0);
}

double WindowForce::share_of(std::int64_t k) const {
  const auto steps = static_cast<double>(window_.steps);
  const double shift_in_steps = window_.shift / (window_.length / steps);
  if (k == window_.steps) return std::max(0.0, 0.5 - shift_in_steps);
  return std::clamp(steps - shift_in_steps - static_cast<double>(k) + 0.5, 0.0, 1.0);
}

void WindowForce::add(std::size_t node, std::int64_t k, const Triple<double>& force) {
  const double share = share_of(k),
               whole = k == window_.steps ? 0 : 1;  // the end's own step is the next window's
  double* mean = mean_.data() + 3 * node;
  const double now = share / static_cast<double>(window_.steps);
  mean[0] += now * force.x;
  mean[1] += now * force.y;
  mean[2] += now * force.z;
  if (share == whole) return;
  const double later = (whole - share) * (window_.length / static_cast<double>(window_.steps));
  double* rest = next_rest_.data() + 3 * node;
  rest[0] += later * force.x;
  rest[1] += later * force.y;
  rest[2] += later * force.z;
  next_loaded_.push_back(node);
}

void WindowForce::add_work(std::int64_t k, double power) {
  const double step = window_.length / static_cast<double>(window_.steps), share = share_of(k),
               whole = k == window_.steps ? 0 : 1;
  work_ += share * step * power;
  next_work_ += (whole - share) * step * power;
}

void WindowForce::archive(core::StateArchive& archive) {
  std::vector<double> work{next_work_};
  archive.values("impulses_left", next_rest_);
  archive.values("work_left", work);
  next_work_ = work.front();
  next_loaded_.clear();
  for (std::size_t i = 0; i < next_rest_.size(); ++i)
    if (next_rest_[i] != 0) next_loaded_.push_back(i / 3);
}

}  // namespace talus::dem
