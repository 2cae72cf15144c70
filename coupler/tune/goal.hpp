#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace talus::tune {

/// How near a result has to be to the truth.
struct Goal {
  std::string text;    ///< as written
  std::string column;  ///< of probes.csv, whose peak is meant; empty: the energy error
  double share = 0;    ///< of the true peak, or of the impact's energy
  bool is_energy() const { return column.empty(); }
};

/// "2 % of peak net_centre.displacement_z_m" or "1 % of energy".
/// @throws ConfigError with what is wrong and what is expected
Goal parse_goal(const std::string& text);

/// What the goal is about in a result: the peak with its sign, or the largest error of the energy balance
/// over the impact's energy, whose truth is 0.
double value_of(const Goal& goal, const nlohmann::json& summary);

/// @throws ConfigError where a goal's column is none of the scene's: lists those there are
void check_columns(const std::vector<Goal>& goals, const nlohmann::json& summary);

}  // namespace talus::tune
