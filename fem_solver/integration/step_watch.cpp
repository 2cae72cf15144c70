#include "fem_solver/integration/step_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "fem_solver/integration/frequency_bound.hpp"
#include "fem_solver/integration/step_limit.hpp"

namespace talus::fem {
namespace {

constexpr double rise_that_counts = 1.02;

}  // namespace

void StepWatch::look(const Moment& moment) {
  const Model& model = assembly_.model();
  const FrequencyBound bound = frequency_bound(model, moment.at);
  if (moment.step <= stable_step(std::sqrt(bound.squared), largest_stiffness_damping(model))) return;
  if (bound.squared <= rise_that_counts * cleared_) return;
  const double limit = stable_step(largest_frequency(assembly_, moment.at), largest_stiffness_damping(model));
  if (moment.step > limit)
    throw core::NumericalError(
        {.what = "the step of " + core::readable(moment.step, "s") +
                 " is above the limit of stability, which fell to " + core::readable(limit, "s") +
                 " as the structure stiffened; take a smaller step",
         .entity = "stiffest for its mass is " + node_name(model, bound.node) + "; limit (s)",
         .step = moment.steps,
         .time = moment.time,
         .value = limit,
         .last_output_time = moment.last_output_time});
  cleared_ = bound.squared;
}

}  // namespace talus::fem
