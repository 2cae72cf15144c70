#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/tune/choices.hpp"
#include "coupler/tune/goal.hpp"
#include "coupler/tune/trials.hpp"

namespace talus::tune {

/// What a goal's number is in the limit of small steps, and how far that is known.
struct Truth {
  double value = 0;
  double bar = 0;                 ///< of the value
  std::optional<double> order{};  ///< observed, of the first way
  std::string way,
      second_way;  ///< "the scene as given", "implicit contact"; the second is empty where there was none
  std::optional<double> differs{};  ///< of the value: how far the second way's is from it
  std::string note{};               ///< why the first way is not trusted, or why there is no second
};

/// A goal must be known this many times better than it asks to tell settings apart.
inline constexpr double sharper_than_goal = 4;

/// The truth of each goal by two ways that have nothing in common but the physics: the scene as given with
/// all its steps and windows halved again and again, and the same with another contact, scheme or method of
/// the structure.
///
/// Of each way the three finest runs tell the order and Richardson's limit (study::observed_order,
/// extrapolate); it is known to as much as that moved the finest run, where the order fits between 1 and 2,
/// else to three times the last change. The truth is that of the way that knows it better, known to no less
/// than what the two differ. Halving ends where every goal is known sharper_than_goal times better than it
/// asks, or the share of the budget is spent; where that is before three runs are there, twice and four times
/// the step serve. The truth of an energy error is 0, known exactly.
/// @returns nothing where not even three runs could be made
std::optional<std::vector<Truth>> find_truth(const std::vector<Goal>& goals, const Candidate& given,
                                             const std::vector<Change>& other_ways, Trials& trials);

/// How far a trial is from the truth of a goal at most: relative, with the bar.
double error_of(const Goal& goal, const Truth& truth, const nlohmann::json& summary);
bool meets(const std::vector<Goal>& goals, const std::vector<Truth>& truth, const Trial& trial);

}  // namespace talus::tune
