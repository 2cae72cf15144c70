#pragma once

#include <string>
#include <vector>

#include "coupler/explain/facts.hpp"

/// What a result says about its scene: effects that did nothing, and effects whose absence shows.
namespace talus::explain {

/// Of the impact's energy; what stays below changes no figure that anybody reads.
inline constexpr double negligible_energy = 1e-6;
/// Of the largest tension; a wire or a sheet without bending stiffness carries none.
inline constexpr double negligible_compression = 0.01;
/// Of the impact's energy, made or lost by the computation itself.
inline constexpr double large_energy_error = 0.01;
/// A strong scheme that needs no more iterations a window than this does what a weak one does.
inline constexpr double idle_iterations = 1.05;

struct Finding {
  enum class Kind { may_be_left_out, seems_missing } kind;
  std::string text;
};

/// A rule looks at one thing only. Several findings where it applies to several parts.
using Rule = std::vector<Finding> (*)(const ResultFacts&);

// What may be left out.
std::vector<Finding> friction_that_turns_nothing(const ResultFacts& facts);
std::vector<Finding> rolling_without_rotation(const ResultFacts& facts);
std::vector<Finding> gravity_that_does_no_work(const ResultFacts& facts);
std::vector<Finding> damping_that_takes_nothing(const ResultFacts& facts);
std::vector<Finding> parts_that_never_dissipate(const ResultFacts& facts);
std::vector<Finding> tension_fields_that_stay_taut(const ResultFacts& facts);
std::vector<Finding> iterations_that_change_nothing(const ResultFacts& facts);
// What seems to be missing.
std::vector<Finding> compression_in_sheets(const ResultFacts& facts);
std::vector<Finding> compression_in_wires(const ResultFacts& facts);
std::vector<Finding> dashpots_too_fast_for_their_nodes(const ResultFacts& facts);
std::vector<Finding> energy_made_by_the_coupling(const ResultFacts& facts);
std::vector<Finding> energy_that_does_not_close(const ResultFacts& facts);

/// All of them, in this order.
const std::vector<Rule>& rules();

}  // namespace talus::explain
