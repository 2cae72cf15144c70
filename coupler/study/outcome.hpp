#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace talus::study {

/// What a point is worth. Only `ok` is shown as good.
enum class Outcome {
  ok,
  warnings,    ///< the run warned, above all of windows that did not converge
  inaccurate,  ///< its balance of energy is off by more than the study allows
  failed,
  missing
};
const char* name_of(Outcome outcome);

struct Worth {
  Outcome outcome = Outcome::missing;
  std::string detail;   ///< a few words for a cell: "37 % of windows not converged", "unstable"
  std::string message;  ///< all there is to say
  bool has_values() const { return outcome < Outcome::failed; }
};

/// The share of a run's windows that did not converge; 0 of a scheme that does not iterate.
double share_not_converged(const nlohmann::json& summary);

/// @param record of a point (runner.hpp)
/// @param largest_energy_error share of the impact's energy
Worth worth_of(const nlohmann::json& record, double largest_energy_error);

}  // namespace talus::study
