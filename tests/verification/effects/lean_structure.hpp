#pragma once

#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/model/model.hpp"
#include "tests/verification/effects/counting.hpp"

namespace talus::test {

/// The explicit structural solver as it would be if it knew one part of one kind of element, held at nodes
/// that do not move, and nothing else: no gravity, damping, loads, prescribed motion, slides, interface, watch.
template <class Batch>
class LeanStructure final : public Stepper {
 public:
  /// @pre the model's only part is made of such elements
  LeanStructure(const fem::Model& model, double step);
  void step() override;

 private:
  void sum_at_nodes() noexcept;
  void hold_supports() noexcept;
  double move_nodes() noexcept;

  const fem::Model& model_;
  const Batch& elements_;
  double step_, previous_step_ = 0;
  std::vector<double> displacement_, velocity_, force_, reactions_, inverse_mass_, slots_, sums_;
  std::vector<fem::Index> incidence_begin_, incidence_;
};

}  // namespace talus::test
