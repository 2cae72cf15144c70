#pragma once

#include <span>

#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// When loads are evaluated.
struct LoadTime {
  double time = 0;  ///< s
  double ramp = 1;  ///< factor on gravity, loads and prescribed motion without a table of their own
};

/// The factor of a load or a prescribed motion.
inline double load_factor(const TimeTable& history, const LoadTime& when) {
  return history.points.empty() ? when.ramp : history.at(when.time);
}

/// Adds weight, nodal loads and interface forces (N, 3 a node).
void add_external_force(const Model& model, const InterfaceForce& interface, const LoadTime& when,
                        std::span<double> force) noexcept;

/// Works over a change of displacement, each force taken as the mean of its values at both ends (J).
struct ExternalWorks {
  double gravity = 0, loads = 0, interface = 0, supports = 0;
  bool operator==(const ExternalWorks&) const = default;
};
void archive(core::StateArchive& archive, ExternalWorks& works);

struct LoadSpan {
  LoadTime before, after;
};
void add_works(const Model& model, const InterfaceForce& interface, const LoadSpan& span,
               std::span<const double> change_of_displacement, ExternalWorks& works) noexcept;

/// Puts the held directions where they are led.
void place_supports(std::span<const HeldDirection> held, const LoadTime& when,
                    std::span<double> displacement) noexcept;

/// 3 a node of each support.
std::size_t reaction_count(const Model& model);

}  // namespace talus::fem
