#include "fem_solver/integration/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/integration/external_force.hpp"

namespace talus::fem {
namespace {

constexpr double local_damping = 0.7;
constexpr std::int64_t steps_between_bounds = 20;  // the stiffness changes as the structure falls into place

class Relaxation {
 public:
  Relaxation(const Model& model, Assembly& assembly, State from)
      : model_(model), assembly_(assembly), held_(held_directions(model)), state_(std::move(from)) {
    std::ranges::fill(state_.velocity, 0.0);
    force_.resize(state_.displacement.size());
    external_.assign(state_.displacement.size(), 0.0);
    add_external_force(model, {}, {.time = 0}, external_);
    for (const double f : external_) largest_external_ = std::max(largest_external_, std::abs(f));
    place_supports(held_, {.time = 0}, state_.displacement);
  }

  State run(const RelaxationOptions& options) {
    for (std::int64_t n = 0; n < options.most_steps; ++n) {
      if (n % steps_between_bounds == 0) take_masses();
      if (evaluate() <= options.tolerance) {
        state_.velocity = initial_state(model_).velocity;
        return std::move(state_);
      }
      step();
    }
    report_failure(options);
  }

 private:
  void take_masses() {
    const std::vector<double> sums = stiffness_bounds(model_, state_.configuration());
    masses_.resize(sums.size() / 3);
    for (std::size_t node = 0; node < masses_.size(); ++node)
      masses_[node] = std::max({sums[3 * node], sums[3 * node + 1], sums[3 * node + 2]});
  }
  /// @return the largest force left over the largest force
  double evaluate() {
    assembly_.internal_force(state_.configuration(), force_);
    std::ranges::copy(assembly_.next_memory(), state_.memory.begin());
    for (std::size_t i = 0; i < force_.size(); ++i) force_[i] += external_[i];
    for (const HeldDirection& h : held_) force_[h.direction] = 0;
    worst_ = static_cast<std::size_t>(
        std::ranges::max_element(force_, {}, [](double f) { return std::abs(f); }) - force_.begin());
    const double scale = std::max(assembly_.largest_element_force(), largest_external_);
    left_ = scale > 0 ? std::abs(force_[worst_]) / scale : 0;
    if (!std::isfinite(left_)) fail("the forces are not finite as the structure falls into place", left_);
    return left_;
  }
  void step() {
    for (std::size_t i = 0; i < force_.size(); ++i) {
      double& way = state_.velocity[i];
      const double brake = way == 0 ? 0 : std::copysign(local_damping * std::abs(force_[i]), way);
      if (masses_[i / 3] > 0) way += (force_[i] - brake) / masses_[i / 3];
      state_.displacement[i] += way;
    }
  }
  [[noreturn]] void report_failure(const RelaxationOptions& options) const {
    fail(fmt::format(
             "the structure has not come to rest within {} steps; more `steps`, or something to hold it, may "
             "help",
             options.most_steps),
         left_);
  }
  [[noreturn]] void fail(const std::string& what, double value) const {
    throw core::NumericalError({.what = "structure.start: " + what,
                                .entity = "force left over the largest force, on " +
                                          node_name(model_, static_cast<Index>(worst_ / 3)),
                                .step = -1,
                                .time = 0,
                                .value = value,
                                .last_output_time = -1});
  }

  const Model& model_;
  Assembly& assembly_;
  std::vector<HeldDirection> held_;
  State state_;
  std::vector<double> masses_;  ///< N/m, one a node
  std::vector<double> force_, external_;
  double largest_external_ = 0;  ///< N
  double left_ = 0;
  std::size_t worst_ = 0;
};

}  // namespace

State relax(const Model& model, Assembly& assembly, const RelaxationOptions& options, State from) {
  return Relaxation(model, assembly, std::move(from)).run(options);
}

}  // namespace talus::fem
