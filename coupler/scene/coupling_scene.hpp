#pragma once

#include <optional>
#include <variant>

#include "core/scene/fields.hpp"

/// `coupling:` how often and in which order the two sides hear of each other.
namespace talus::coupler {

/// `serial_explicit: {}` has nothing to choose.
struct SerialExplicitScene {};
void describe(core::Fields& fields, SerialExplicitScene& scheme);

struct CouplingScene {
  std::optional<double> window;  ///< s; absent: time.step
  double timeout = 300;          ///< s
  double join_timeout = 60;      ///< s
  std::variant<std::monostate, SerialExplicitScene> scheme;
};
void describe(core::Fields& fields, CouplingScene& coupling);

}  // namespace talus::coupler
