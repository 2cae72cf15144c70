#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "coupler/schemes/unknowns.hpp"

namespace talus::core {
class StateArchive;
}

namespace talus::coupler {

/// When a window of a strong scheme counts as converged: on every field,
///     |after - before| <= max(absolute, relative |after|)        (Euclidean norms over the nodes)
struct Convergence {
  double relative = 1e-6;
  /// In m, m/s and N: below these a change is round-off, whatever the field's size.
  std::array<double, 3> absolute{1e-12, 1e-9, 1e-9};
  int most_iterations = 50;
  std::int64_t most_halvings = 0;  ///< of a window that takes more
  /// Where it may not be halved any more. false: go on with the last iterate, counted as a warning
  bool fail_otherwise = true;

  /// The field that is worst, relative to what is allowed; converged where that is at most 1.
  struct Verdict {
    FieldName worst = FieldName::displacement;
    double ratio = 0;  ///< change over what is allowed
    bool converged() const { return ratio <= 1; }
  };
  Verdict judge(const std::array<FieldChange, 3>& changes) const;
};

const char* name_of(FieldName field);

/// What the windows of a strong scheme cost.
struct IterationTally {
  std::int64_t windows = 0, iterations = 0, not_converged = 0;
  std::int64_t most = 0;             ///< iterations of the worst window
  std::int64_t in_contact = 0;       ///< windows at whose end forces act between the sides
  std::int64_t most_in_contact = 0;  ///< iterations of the worst of these
  std::int64_t halved = 0;           ///< windows that were taken back and computed as two halves
  std::int64_t most_halvings = 0;    ///< of the shortest window
  void archive(core::StateArchive& archive);
};

/// @throws core::NumericalError naming the window, the field and how far it is from converged
[[noreturn]] void fail_not_converged(const Window& window, int iterations,
                                     const Convergence::Verdict& verdict);

}  // namespace talus::coupler
