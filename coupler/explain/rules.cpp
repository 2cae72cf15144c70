#include "coupler/explain/rules.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::explain {
namespace {

constexpr auto may_be_left_out = Finding::Kind::may_be_left_out;
constexpr auto seems_missing = Finding::Kind::seems_missing;

/// Of the impact's energy; nothing where the line is not there, or nothing moved.
std::optional<double> share_of(const ResultFacts& facts, const std::string& line) {
  const double impact = facts.impact();
  const auto largest = facts.largest(line);
  if (!largest || !(impact > 0)) return std::nullopt;
  return *largest / impact;
}

std::string in_the_scene(const EffectFacts& effect) {
  return effect.key.empty() ? effect.name : fmt::format("{} (`{}`)", effect.name, effect.key);
}

}  // namespace

std::vector<Finding> effects_that_do_nothing(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& effect : facts.effects) {
    if (!effect.present || effect.ledger_line.empty()) continue;
    const auto share = share_of(facts, effect.ledger_line);
    if (!share || *share >= (effect.may_hold ? round_off_energy : negligible_energy)) continue;
    findings.push_back(
        {may_be_left_out,
         fmt::format("{}: {} stays at {:.2g} of the impact; without it no peak changes by more than {:g} %",
                     in_the_scene(effect), effect.ledger_line, *share, 100 * promised),
         effect.key});
  }
  return findings;
}

std::vector<Finding> slackness_that_never_shows(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& part : facts.parts) {
    const EffectFacts* effect = facts.against("compression of " + part.name);
    if (!effect || !effect->present || part.gave_way.value_or(true) || part.frames < telling_frames) continue;
    findings.push_back(
        {may_be_left_out,
         fmt::format("{}: `{}` stays taut in all {} frames", in_the_scene(*effect), part.name, part.frames),
         effect->key});
  }
  return findings;
}

std::vector<Finding> iterations_that_change_nothing(const ResultFacts& facts) {
  const auto iterations = facts.summary.value("iterations", nlohmann::json::object());
  const auto in_contact = iterations.value("in_contact", nlohmann::json::object());
  const auto windows = in_contact.value("windows", std::int64_t{0});
  const bool all_at_once = windows > 0 && in_contact.value("most", std::int64_t{0}) == 1;
  if (!all_at_once || iterations.value("windows_halved", std::int64_t{0}) > 0 ||
      iterations.value("windows_not_converged", std::int64_t{0}) > 0)
    return {};
  return {{may_be_left_out,
           fmt::format("the strong scheme takes one iteration in each of the {} windows with contact: "
                       "`serial_explicit` gives the same within the scheme's tolerance",
                       windows)}};
}

std::vector<Finding> compression_that_an_effect_takes_away(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& part : facts.parts) {
    const EffectFacts* effect = facts.against("compression of " + part.name);
    const bool is_post = part.kind == PartFacts::Kind::line && part.compression > part.tension;
    if (!effect || effect->present || is_post || part.compression <= negligible_compression * part.tension)
      continue;
    findings.push_back(
        {seems_missing,
         fmt::format("compression up to {:.2g} % of the tension in `{}`: {} is out and would take it away",
                     100 * part.compression / part.tension, part.name, in_the_scene(*effect))});
  }
  return findings;
}

std::vector<Finding> limits_that_an_effect_lifts(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& limit : facts.summary.value("limits", nlohmann::json::array())) {
    const auto name = limit.at("name").get<std::string>();
    const EffectFacts* effect = facts.against(name);
    if (!limit.value("exceeded", false) || !effect || effect->present) continue;
    findings.push_back(
        {seems_missing, fmt::format("the step is {:.2g} times the limit '{}': {} lifts it",
                                    limit.at("step_s").get<double>() / limit.at("limit_s").get<double>(),
                                    name, in_the_scene(*effect))});
  }
  return findings;
}

std::vector<Finding> energy_made_by_the_coupling(const ResultFacts& facts) {
  const auto share = share_of(facts, "interface.created_J");
  if (!share || *share <= large_energy_error) return {};
  return {
      {seems_missing,
       fmt::format(
           "the coupling makes or loses {:.2g} of the impact: a smaller `coupling.window` or a strong scheme",
           *share)}};
}

std::vector<Finding> energy_that_does_not_close(const ResultFacts& facts) {
  const double error = facts.summary.at("energy").at("largest_error_relative").get<double>();
  if (std::abs(error) <= large_energy_error) return {};
  return {{seems_missing, fmt::format("the energy balance is off by {:.2g} % of the impact: a smaller step",
                                      100 * std::abs(error))}};
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{effects_that_do_nothing,        slackness_that_never_shows,
                                     iterations_that_change_nothing, compression_that_an_effect_takes_away,
                                     limits_that_an_effect_lifts,    energy_made_by_the_coupling,
                                     energy_that_does_not_close};
  return all;
}

std::vector<Finding> findings_of(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const Rule rule : rules()) {
    const auto found = rule(facts);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  return findings;
}

}  // namespace talus::explain
