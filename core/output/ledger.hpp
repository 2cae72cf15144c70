#pragma once

#include <span>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// The energy ledger's balance over a run.
///
///     balance = sum of stored + sum of dissipated - sum of supplied            (J)
///     (memo lines count nowhere)
///     error   = balance now - balance in the first row                         (J)
///     error_relative = error / (largest sum of the stored lines named kinetic, over the run so far)
///
/// A run that conserves what its ledger counts has an error of zero. error_relative is 0 as long as nothing
/// has moved.
class LedgerBalance {
 public:
  struct Row {
    double error = 0;           ///< J
    double error_relative = 0;  ///< of the largest kinetic energy so far
  };

  explicit LedgerBalance(std::vector<LedgerDescription> lines) : lines_(std::move(lines)) {}

  /// @pre joules.size() == lines; one call a row, in the order of time
  Row add(std::span<const double> joules);
  const std::vector<LedgerDescription>& lines() const { return lines_; }
  const Row& last() const { return last_; }
  /// The row whose error has the largest magnitude.
  const Row& largest() const { return largest_; }

 private:
  std::vector<LedgerDescription> lines_;
  bool started_ = false;
  double first_balance_ = 0;
  double largest_kinetic_ = 0;
  Row last_, largest_;
};

}  // namespace talus::core
