#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupler/tune/choices.hpp"
#include "coupler/tune/truth.hpp"

namespace talus::core {
class SceneFile;
}

namespace talus::tune {

/// What became of an effect that `talus explain` proposed to leave out.
struct EffectTried {
  std::string key;
  bool dropped = false;
  /// Of each goal's number, of the value with it; empty where the scene without it did not run.
  std::vector<double> changes{};
  std::string note{};
};

struct Found {
  std::optional<std::string> best;  ///< id of the trial; nothing where none meets the goals
  std::vector<EffectTried> effects;
  std::set<std::string> lucky{};  ///< ids of trials that meet the goals, and with half of their steps do not
  bool complete = true;           ///< false: the budget ended the search
};

/// The cheapest settings that meet the goals.
///
/// 1. **Families**: the scene's own methods, and each other one. Of each the longest step (all steps and
///    windows together) that meets the goals: from the longest that limits of stability allow, so that cheap
///    runs come first. Two runs of a family tell the order of its error, and with it the step that is tried
///    next; a family ends where the step that would do takes longer than the best so far.
/// 2. **Effects** that explain proposes to leave out of the best.
/// 3. **Moves** from the best: longer steps of a side, the window alone, mass scaling, other slides, coarser
///    meshes. What meets the goals in less time is where the next moves start, until none is better.
///
/// What would be the best also has to meet the goals with half of its steps: an error that changes its sign
/// on the way passes through nothing, and would meet them by luck.
///
/// Never beyond a limit of stability: the programs refuse it before time 0, and such a trial is only listed.
Found search(const core::SceneFile& scene, const std::vector<Goal>& goals, const std::vector<Truth>& truth,
             const Candidate& given, Trials& trials);

/// A move has to save so much of the time to count: timings are no better known.
inline constexpr double worth_a_move = 0.03;

}  // namespace talus::tune
