#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/output/ledger.hpp"

namespace talus::core {

/// How far the energy balance of a run may be off, as a share of LedgerBalance::scale(), the run's impact.
struct EnergyErrorScene {
  double warning = 0.02;
  double error = 0.2;  ///< from here on a run does not end as finished
};

/// Watches the balance of a run row by row: no run may be wrong by more than its scene allows and say
/// "finished".
///
/// In the first rows hardly any energy has been on the move yet, and the two time levels of a leapfrog alone
/// make large shares of it. So a run is ended early only by many rows in a row that are off; at its end the
/// largest error counts, against all that has been on the move.
class EnergyGuard {
 public:
  EnergyGuard(const EnergyErrorScene& limits, const LedgerBalance& balance)
      : limits_(limits), balance_(balance) {}

  /// After each row. @returns what there is to warn about, each thing once in a run
  /// @throws NumericalError where the run is lost
  std::vector<std::string> look(double time);
  /// At the end of a run. @throws NumericalError where the largest error was too large
  void judge(double time) const;

 private:
  bool exceeds(double error, double share) const;
  [[noreturn]] void fail(double time, double error) const;

  EnergyErrorScene limits_;
  const LedgerBalance& balance_;
  std::int64_t rows_off_ = 0;  ///< in a row
  bool warned_ = false, warned_of_dissipation_ = false;
  static constexpr std::int64_t most_rows_off = 20;
};

}  // namespace talus::core
