#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// The energy ledger's balance over a run.
///
///     balance = sum of stored + sum of dissipated - sum of supplied            (J)
///     (memo lines count nowhere)
///     error   = balance now - balance in the first row                         (J)
///     scale   = the largest so far of: sum of the stored lines named kinetic;
///               what was supplied on the whole since the first row;
///               what the stored lines named elastic have given up since then  (J)
///     error_relative = error / scale
///
/// A run that conserves what its ledger counts has an error of zero. The scale is the impact of a rock, what a
/// fall or a load brings in, what a prestress lets go, whichever is more; a row knows only what came before it, the run's largest error is
/// measured by the scale of the whole run. error_relative is 0 as long as nothing has moved.
class LedgerBalance {
 public:
  struct Row {
    double error = 0;           ///< J
    double error_relative = 0;  ///< of the scale so far
  };

  explicit LedgerBalance(std::vector<LedgerDescription> lines)
      : lines_(std::move(lines)), highest_(lines_.size()) {}

  /// @pre joules.size() == lines; one call a row, in the order of time
  Row add(std::span<const double> joules);
  const std::vector<LedgerDescription>& lines() const { return lines_; }
  const Row& last() const { return last_; }
  /// The error of the largest magnitude, and what it is of the scale of all rows.
  Row largest() const;
  /// J; the energy that the run is about.
  double scale() const { return scale_; }
  /// J; an error below this is round-off of the stored energies.
  double round_off() const { return 1e-9 * largest_stored_; }

  struct Fall {
    std::size_t line = 0;
    double joules = 0;  ///< below the line's highest value so far
  };
  /// The dissipated line that has lost most in the last row.
  std::optional<Fall> most_fallen() const { return most_fallen_; }

 private:
  std::vector<LedgerDescription> lines_;
  std::vector<double> highest_;  ///< J; of each line
  bool started_ = false;
  double first_balance_ = 0, first_supplied_ = 0, first_elastic_ = 0;
  double scale_ = 0, largest_stored_ = 0, largest_error_ = 0;
  Row last_;
  std::optional<Fall> most_fallen_;
};

}  // namespace talus::core
