#pragma once

#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/assembly/assembly.hpp"
#include "tests/verification/effects/counting.hpp"

namespace talus::test {

/// The explicit structural solver as it would be if it knew elements, held at nodes that do not move, and
/// nothing else: no gravity, damping, loads, prescribed motion, slides, interface, watch, works, clock.
class LeanStructure final : public Stepper {
 public:
  LeanStructure(const fem::Model& model, double step);
  void step() override;

 private:
  void hold_supports(double kick) noexcept;
  double move_nodes(double kick) noexcept;
  double move_nodes(double kick, core::Block values) noexcept;

  const fem::Model& model_;
  fem::Assembly assembly_;
  double step_, previous_step_ = 0;
  std::vector<double> displacement_, velocity_, force_, reactions_, inverse_mass_;
  core::OrderedSum<> sum_;
};

}  // namespace talus::test
