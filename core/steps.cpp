#include "core/steps.hpp"

#include <fmt/format.h>

#include "core/units/units.hpp"

namespace talus::core {

std::string words_about_length(const char* what, double end, double named) {
  const EqualSteps equal = equal_steps(end, named);
  if (equal.length == named) return {};
  return fmt::format("the run of {} is no multiple of the {} of {}: it is cut into {} equal ones of {}",
                     readable(end, "s"), what, readable(named, "s"), equal.count,
                     readable(equal.length, "s"));
}

}  // namespace talus::core
