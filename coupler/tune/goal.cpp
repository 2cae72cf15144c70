#include "coupler/tune/goal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "core/errors.hpp"
#include "core/scene/tree.hpp"
#include "core/units/units.hpp"

namespace talus::tune {
namespace {

constexpr const char* goal_form =
    "write '2 % of peak COLUMN', with a column of probes.csv, or '1 % of energy'";

std::vector<std::string> columns_of(const nlohmann::json& summary) {
  std::vector<std::string> names;
  for (const auto& [name, peak] : summary.at("peaks").items()) names.push_back(name);
  return names;
}

}  // namespace

Goal parse_goal(const std::string& text) {
  static const std::regex form(R"(\s*(\S+)\s*%\s+of\s+(?:(energy)|peak\s+(\S+))\s*)");
  std::smatch found;
  if (!std::regex_match(text, found, form))
    throw core::ConfigError(fmt::format("--within: {} is no goal; {}", core::quoted(text), goal_form));
  const auto percent = core::parse_quantity(found[1], "");
  if (!percent || !(*percent > 0 && *percent < 100))
    throw core::ConfigError(
        fmt::format("--within: {}: the share must be a number between 0 and 100, but is {}; {}",
                    core::quoted(text), core::quoted(found[1]), goal_form));
  return {.text = text, .column = found[3], .share = *percent / 100};
}

double value_of(const Goal& goal, const nlohmann::json& summary) {
  if (goal.is_energy()) return summary.at("energy").at("largest_error_relative");
  return summary.at("peaks").at(goal.column).at("value");
}

void check_columns(const std::vector<Goal>& goals, const nlohmann::json& summary) {
  const auto names = columns_of(summary);
  for (const auto& goal : goals) {
    if (goal.is_energy()) continue;
    if (summary.at("peaks").contains(goal.column)) {
      if (value_of(goal, summary) != 0) continue;
      throw core::ConfigError(
          fmt::format("--within: the peak of {} is 0: no share of it can be asked for", goal.column));
    }
    const std::string near = core::nearest_name(goal.column, names);
    throw core::ConfigError(fmt::format(
        "--within: the scene has no peak '{}'{}; there are: {}", goal.column,
        near.empty() ? "" : fmt::format("; did you mean '{}'?", near),
        names.empty() ? "none (the scene has no probes)" : fmt::format("{}", fmt::join(names, ", "))));
  }
}

}  // namespace talus::tune
