#include "core/output/energy_guard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"

namespace talus::core {

std::vector<std::string> EnergyGuard::look(double time) {
  std::vector<std::string> warnings;
  const double error = balance_.last().error;
  rows_off_ = exceeds(error, limits_.error) ? rows_off_ + 1 : 0;
  if (rows_off_ > most_rows_off) fail(time, error);
  if (!warned_ && rows_off_ == 0 && exceeds(error, limits_.warning)) {
    warned_ = true;
    warnings.push_back(fmt::format(
        "at {:.6g} s the energy balance is off by {:.3g} J, {:.3g} % of the run's impact of {:.4g} J "
        "(`output.energy_error.warning` is {:g} %)",
        time, error, 100 * std::abs(error) / balance_.scale(), balance_.scale(), 100 * limits_.warning));
  }
  const auto fallen = balance_.most_fallen();
  if (!warned_of_dissipation_ && fallen && exceeds(fallen->joules, limits_.warning)) {
    warned_of_dissipation_ = true;
    warnings.push_back(
        fmt::format("at {:.6g} s {} has fallen by {:.3g} J: what is dissipated cannot come back, so a step "
                    "is too long for it",
                    time, balance_.lines()[fallen->line].name, fallen->joules));
  }
  return warnings;
}

void EnergyGuard::judge(double time) const {
  const double error = balance_.largest().error;
  if (exceeds(error, limits_.error)) fail(time, error);
}

bool EnergyGuard::exceeds(double error, double share) const {
  if (balance_.scale() == 0) return false;  // nothing was on the move
  return std::abs(error) > share * balance_.scale() && std::abs(error) > balance_.round_off();
}

void EnergyGuard::fail(double time, double error) const {
  throw NumericalError(
      {.what = fmt::format(
           "the energy balance is off by {:.3g} % of the run's impact of {:.4g} J, more than the {:g} % "
           "of `output.energy_error.error`",
           100 * std::abs(error) / balance_.scale(), balance_.scale(), 100 * limits_.error),
       .entity = "error of the balance (J)",
       .time = time,
       .value = error,
       .last_output_time = time});
}

}  // namespace talus::core
