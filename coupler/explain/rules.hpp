#pragma once

#include <string>
#include <vector>

#include "coupler/explain/facts.hpp"

/// What a result says about its scene: effects that did nothing, and effects whose absence shows. Rules know what
/// participants declared of their effects (ledger line, limit, key), and no names of any program's effects. What is not
/// in the result is unknown, and nothing is advised on it.
namespace talus::explain {

/// Of the impact's energy. An effect of less changes no peak by more than `promised`, its square root.
inline constexpr double negligible_energy = 1e-6;
/// Of a peak; what following an advice changes at most.
inline constexpr double promised = 1e-3;
/// Of the impact's energy: the square of round-off, which stands in a line of something that never moved.
inline constexpr double round_off_energy = 1e-24;
/// Of the largest tension; a wire or a sheet without bending stiffness carries none.
inline constexpr double negligible_compression = 0.01;
/// Of the impact's energy, made or lost by the computation itself.
inline constexpr double large_energy_error = 0.01;
/// Fewer frames say nothing of what happened between them.
inline constexpr std::int64_t telling_frames = 20;

struct Finding {
  enum class Kind { may_be_left_out, seems_missing } kind;
  std::string text;
  std::string key = {};  ///< of the scene, that names what may be left out; empty: none alone does
};

/// A rule looks at one thing only. Several findings where it applies to several parts.
using Rule = std::vector<Finding> (*)(const ResultFacts&);

// What may be left out.
/// Effects whose declared line stays negligible; those that may hold without work, only where it stays at round-off.
std::vector<Finding> effects_that_do_nothing(const ResultFacts& facts);
/// Effects against compression in parts that never gave way to any.
std::vector<Finding> slackness_that_never_shows(const ResultFacts& facts);
/// A strong scheme whose every window with contact took one iteration.
std::vector<Finding> iterations_that_change_nothing(const ResultFacts& facts);
// What seems to be missing.
/// Parts that are pressed although they mostly pull, where an effect that is out would take the compression away.
std::vector<Finding> compression_that_an_effect_takes_away(const ResultFacts& facts);
/// Step limits that are exceeded, where an effect that is out would lift them.
std::vector<Finding> limits_that_an_effect_lifts(const ResultFacts& facts);
std::vector<Finding> energy_made_by_the_coupling(const ResultFacts& facts);
std::vector<Finding> energy_that_does_not_close(const ResultFacts& facts);

/// All of them, in this order.
const std::vector<Rule>& rules();
/// What all rules find.
std::vector<Finding> findings_of(const ResultFacts& facts);

}  // namespace talus::explain
