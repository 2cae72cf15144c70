#pragma once

#include <span>

#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// When loads are evaluated.
struct LoadTime {
  double time = 0;  ///< s
  double ramp = 1;  ///< factor on gravity, and on loads and prescribed motion without a table of their own
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

/// Puts the supported directions where they are led.
void place_supports(const Model& model, const LoadTime& when, std::span<double> displacement) noexcept;

/// visit(support, first direction of the node in arrays of 3 a node, offset into the reactions)
template <class Visit>
void for_each_support(const Model& model, const Visit& visit) {
  std::size_t offset = 0;
  for (const auto& support : model.supports) {
    for (const Index node : support.nodes) {
      visit(support, 3 * static_cast<std::size_t>(node), offset);
      offset += 3;
    }
  }
}

/// 3 a node of each support.
std::size_t reaction_count(const Model& model);

}  // namespace talus::fem
