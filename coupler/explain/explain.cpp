#include "coupler/explain/explain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/explain/rules.hpp"

namespace talus::explain {
namespace {

/// One stage of a side's steps, as a column "structure_time.motion_of_nodes_s" tells it.
struct StageTime {
  std::string side, stage;
  double seconds = 0;
};

std::vector<StageTime> stage_times(const nlohmann::json& summary) {
  constexpr std::string_view mark = "_time.", unit = "_s";
  std::vector<StageTime> times;
  for (const auto& [column, value] : summary.at("last").items()) {
    const auto at = column.find(mark);
    if (at == std::string::npos || !column.ends_with(unit)) continue;
    const auto begin = at + mark.size();
    std::string stage = column.substr(begin, column.size() - unit.size() - begin);
    std::ranges::replace(stage, '_', ' ');
    times.push_back({column.substr(0, at), std::move(stage), value.get<double>()});
  }
  std::ranges::stable_sort(times, std::greater{}, &StageTime::seconds);
  return times;
}

std::string time_shares(const nlohmann::json& summary) {
  const auto times = stage_times(summary);
  const double wall = summary.at("wall_time_s").get<double>();
  if (times.empty())
    return "time: not measured; write `output: {stage_times: {}}` into the scene to have it\n";
  std::string text = fmt::format(
      "time (share of the {:.3g} s of the run; the sides may work at the same time; the rest is coupling, "
      "waiting and output)\n",
      wall);
  for (const auto& time : times)
    text += fmt::format("  {:>5.1f} %  {:<10} {}\n", 100 * time.seconds / wall, time.side, time.stage);
  return text;
}

std::string energy_shares(const ResultFacts& facts) {
  const double impact = facts.impact();
  std::string text =
      fmt::format("energy (largest of each line, and its share of the impact's {:.4g} J)\n", impact);
  for (const auto& [line, kind] : facts.summary.at("energy").at("kinds").items()) {
    const auto found = facts.largest(line);
    if (!found) continue;  // unknown, not zero
    const double largest = *found;
    text += fmt::format("  {:>8.3g} %  {:>12.4g} J  {:<10} {}\n", impact > 0 ? 100 * largest / impact : 0,
                        largest, kind.get<std::string>(), line);
  }
  return text;
}

std::string listed(const std::string& heading, const std::vector<Finding>& findings, Finding::Kind kind) {
  std::string text = heading + "\n";
  for (const auto& finding : findings)
    if (finding.kind == kind) text += "  - " + finding.text + "\n";
  if (std::ranges::none_of(findings, [=](const auto& finding) { return finding.kind == kind; }))
    text += "  nothing found\n";
  return text;
}

std::string listed_effects(const nlohmann::json& summary) {
  std::string text = "effects\n";
  for (const auto& effect : summary.value("effects", nlohmann::json::array()))
    text += fmt::format("  {:<3} {:<10} {:<32} {}\n", effect.at("present") ? "in" : "out",
                        effect.at("side").get<std::string>(), effect.at("name").get<std::string>(),
                        effect.at("reason").get<std::string>());
  return text;
}

}  // namespace

std::string explanation(const ResultFacts& facts) {
  const auto findings = findings_of(facts);
  std::string text = listed_effects(facts.summary) + time_shares(facts.summary) + energy_shares(facts) +
                     listed("may be left out", findings, Finding::Kind::may_be_left_out) +
                     listed("seems to be missing", findings, Finding::Kind::seems_missing);
  if (facts.impact() <= 0)
    text += "  (nothing moves in any row, so that no energy can be compared with an impact's)\n";
  if (facts.parts.empty())
    text += "  (stresses were not looked at: the result has no frames, see output.fields_every)\n";
  return text;
}

}  // namespace talus::explain
