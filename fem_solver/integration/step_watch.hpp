#pragma once

#include <cstdint>
#include <span>

#include "fem_solver/assembly/assembly.hpp"

namespace talus::fem {

/// Sees to it that an explicit run ends, and says why, where the structure has become too stiff for its step:
/// stretched by a fifth a bar has 1.66 times its stiffness, a slider at the end of its rope or a brake at its
/// stop more. Every `interval` steps it bounds the highest frequency by the tangent's row sums; only where
/// that does not clear the step is the limit itself computed, and once more whenever the bound has risen by
/// 2 % since.
class StepWatch {
 public:
  static constexpr std::int64_t interval = 200;  ///< costs 0.12 % of the steps between

  /// @pre assembly outlives the watch
  explicit StepWatch(Assembly& assembly) : assembly_(assembly) {}

  struct Moment {
    Configuration at;
    double step = 0;               ///< s, of the steps to come
    double time = 0;               ///< s
    std::int64_t steps = 0;        ///< taken so far
    double last_output_time = -1;  ///< s; negative: none
  };
  /// @throws core::NumericalError where the step is above the limit at this moment; names the node where the
  /// structure is stiffest for its mass
  void look(const Moment& moment);

 private:
  Assembly& assembly_;
  double cleared_ = 0;  ///< 1/s^2; the bound up to which the computed limit allows the step
};

}  // namespace talus::fem
