#include "coupler/tune/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/program/log.hpp"
#include "core/scene/reader.hpp"

namespace talus::tune {
namespace {

constexpr int longest_start = 4;  // doublings of the scene's steps
/// Of a family whose methods do not go with the scene.
constexpr int most_failures = 3;
constexpr int most_trials = 12;              // of a family
constexpr double shortest_factor = 1. / 64;  // of the scene's steps
/// Of a step: two that are nearer are not told apart.
constexpr double near_steps = 1.15;
/// Of the best time: a run that takes longer is given up, and what took longer once is not timed again.
constexpr double cannot_win = 2;
/// Timings of what may be the best; of runs that take longer than this (s) one is enough.
constexpr int timings = 3;
constexpr double one_timing_from = 30;

class Search {
 public:
  Search(const core::SceneFile& scene, const std::vector<Goal>& goals, const std::vector<Truth>& truth,
         const Candidate& given, Trials& trials)
      : scene_(scene), goals_(goals), truth_(truth), given_(given), trials_(trials) {}

  Found run() {
    if (const Trial* own = trials_.run(given_)) consider(*own);
    family(given_);
    for (const auto& method : other_methods(scene_)) family(given_.with(method));
    if (best_ != nullptr) move_on();
    found_.complete = !trials_.out_of_budget() && !trials_.stopped();
    if (best_ != nullptr) found_.best = best_->id;
    return found_;
  }

 private:
  double excess(const Trial& trial) const {
    double largest = 0;
    for (std::size_t g = 0; g < goals_.size(); ++g)
      largest = std::max(largest, error_of(goals_[g], truth_[g], trial.summary) / goals_[g].share);
    return largest;
  }
  /// The error without what the truth is known to, which shows no order.
  double plain_excess(const Trial& trial) const {
    double largest = 0;
    for (std::size_t g = 0; g < goals_.size(); ++g)
      largest = std::max(largest,
                         (error_of(goals_[g], truth_[g], trial.summary) - truth_[g].bar) / goals_[g].share);
    return largest;
  }
  double best_seconds() const { return best_ ? best_->least() : HUGE_VAL; }

  /// Makes it the best where it meets the goals in less time, each timed some times where one timing says
  /// little.
  bool consider(const Trial& trial) {
    if (!meets(goals_, truth_, trial) || trial.least() > cannot_win * best_seconds() ||
        found_.lucky.contains(trial.id))
      return false;
    const Trial* timed = trial.least() < one_timing_from ? trials_.run(trial.candidate, timings) : &trial;
    if (timed == nullptr || !timed->good || timed->least() >= (1 - worth_a_move) * best_seconds())
      return false;
    if (is_lucky(*timed)) return false;
    best_ = timed;
    core::log_info(fmt::format("the best so far: {}", timed->name));
    return true;
  }

  /// An error that passes through nothing on its way meets every goal there, and none beside it.
  bool is_lucky(const Trial& trial) {
    const Trial* finer =
        tried_with(trial.candidate, accuracy::with_all(trial.candidate.clock, 0.5), HUGE_VAL);
    if (finer == nullptr || meets(goals_, truth_, *finer)) return false;
    core::log_info(
        fmt::format("{} meets the goals by luck: with half of its steps they are missed", trial.name));
    found_.lucky.insert(trial.id);
    return true;
  }

  /// @returns null where it is not run: out of budget, or no clock
  const Trial* tried_with(Candidate candidate, const std::optional<accuracy::Clock>& clock, double longest) {
    if (!clock) return nullptr;
    candidate.clock = *clock;
    return trials_.run(candidate, 1, longest);
  }
  const Trial* tried(const Candidate& candidate, const std::optional<accuracy::Clock>& clock) {
    return tried_with(candidate, clock, cannot_win * best_seconds());
  }

  /// What is known of a family's error and time over its step.
  struct Step {
    double factor, error, seconds;
  };

  /// The longest steps of these methods that meet the goals.
  void family(const Candidate& methods) {
    double factor = std::ldexp(1, longest_start);
    while (factor > 1 && !accuracy::with_all(methods.clock, factor)) factor /= 2;
    std::vector<Step> ran;
    double failed_above = HUGE_VAL;  // the shortest step that was too long
    double met = 0;                  // the longest one that met the goals
    int failed = 0;
    for (int trial = 0; trial < most_trials && factor >= shortest_factor; ++trial) {
      if (!ran.empty() && ran.back().seconds * ran.back().factor / factor > cannot_win * best_seconds())
        return;
      const Trial* one = tried(methods, accuracy::with_all(methods.clock, factor));
      if (trials_.stopped() || (one == nullptr && trials_.out_of_budget())) return;
      if (one != nullptr && one->good) {
        ran.push_back({factor, plain_excess(*one), one->least()});
        consider(*one);
      } else if (one != nullptr && one->ending == study::name_of(study::Ending::too_slow)) {
        return;
      } else if (one != nullptr && factor <= 1 && ++failed >= most_failures) {
        return;  // these methods do not go with this scene
      }
      const bool good = one != nullptr && meets(goals_, truth_, *one) && !found_.lucky.contains(one->id);
      (good ? met : failed_above) = good ? std::max(met, factor) : std::min(failed_above, factor);
      const auto next = next_factor(ran, met, failed_above);
      if (!next) return;
      factor = *next;
    }
  }

  /// By the order that the last two runs show, between what failed and what met the goals; else half or
  /// twice.
  std::optional<double> next_factor(const std::vector<Step>& ran, double met, double failed) const {
    if (met > 0 && failed / met < near_steps * near_steps) return std::nullopt;
    double wanted = met > 0 ? std::min(2 * met, std::sqrt(met * std::min(failed, 4 * met))) : failed / 2;
    if (ran.size() >= 2) {
      const Step &a = ran[ran.size() - 2], &b = ran.back();
      const double order = std::log(a.error / b.error) / std::log(a.factor / b.factor);
      double allowed = 1;
      for (std::size_t g = 0; g < goals_.size(); ++g)
        allowed = std::min(allowed, 1 - truth_[g].bar / goals_[g].share);
      const double predicted = b.factor * std::pow(0.9 * allowed / b.error, 1 / order);
      const bool usable = order > 0.3 && order < 4 && std::isfinite(predicted);
      if (usable && predicted > met * near_steps && predicted < failed / near_steps)
        wanted = std::max(predicted, met > 0 ? 0 : failed / 8);
    }
    return wanted;
  }

  using Move = std::function<std::optional<Candidate>(const Candidate&)>;

  Move clock_move(std::function<std::optional<accuracy::Clock>(const accuracy::Clock&)> change) const {
    return [change](const Candidate& from) -> std::optional<Candidate> {
      const auto clock = change(from.clock);
      if (!clock) return std::nullopt;
      Candidate to = from;
      to.clock = *clock;
      return to;
    };
  }

  /// What may save time: longer steps of a side, of all but one side, of the window alone, of all.
  std::vector<Move> moves() const {
    std::vector<Move> all;
    for (const auto& side : given_.clock.sides) {
      for (const double factor : {2.0, 1.5})
        all.push_back(clock_move(
            [=](const accuracy::Clock& clock) { return accuracy::with_step(clock, side.name, factor); }));
      all.push_back(clock_move([=](const accuracy::Clock& clock) {
        const auto longer = accuracy::with_all(clock, 2);
        return longer ? accuracy::with_step(*longer, side.name, 0.5) : std::nullopt;
      }));
    }
    all.push_back(clock_move([](const accuracy::Clock& clock) { return accuracy::with_window(clock, 2); }));
    all.push_back(clock_move([](const accuracy::Clock& clock) {
      accuracy::Clock longer = clock;
      longer.window *= 2;
      return clock.coupled ? std::optional(longer) : std::nullopt;
    }));
    for (const double doublings : {0.5, 0.25, 0.125})
      all.push_back(clock_move(
          [=](const accuracy::Clock& clock) { return accuracy::with_all(clock, std::exp2(doublings)); }));
    all.push_back([this](const Candidate& from) { return with_scaled_mass(scene_, from); });
    for (const auto& change : other_methods(scene_))
      all.push_back([change](const Candidate& from) -> std::optional<Candidate> {
        if (from.change_in(change.group) != nullptr) return std::nullopt;
        return from.with(change);
      });
    for (const auto& change : other_models(scene_))
      all.push_back([change](const Candidate& from) { return from.with(change); });
    return all;
  }

  void move_on() {
    const auto all = moves();
    drop_effects();
    for (bool better = true; better;) {
      better = false;
      for (const auto& move : all) {
        const auto to = move(best_->candidate);
        if (!to || to->id() == best_->id) continue;
        const Trial* trial = trials_.run(*to, 1, cannot_win * best_seconds());
        if (trials_.stopped() || trials_.out_of_budget()) return;
        if (trial != nullptr && consider(*trial)) better = true;
      }
    }
  }

  /// Effects that explain proposes, one after the other; each stays out where the goals are met and no time
  /// is lost.
  void drop_effects() {
    for (const auto& change : effects_that_may_go(scene_, trials_.result_of(*best_))) {
      const Trial before = *best_;
      const Trial* without = trials_.run(before.candidate.with(change), 1, cannot_win * best_seconds());
      EffectTried tried{.key = change.settings.empty() ? change.name
                                                       : change.name.substr(std::string("without ").size())};
      if (without == nullptr) return;
      if (!without->good) {
        tried.note = "the scene without it does not run: " + without->message;
      } else {
        for (const auto& goal : goals_) {
          const double with = value_of(goal, before.summary), left = value_of(goal, without->summary);
          tried.changes.push_back(goal.is_energy() ? std::abs(left) - std::abs(with)
                                                   : std::abs(left - with) / std::abs(with));
        }
        tried.dropped = consider(*without);
        if (!tried.dropped)
          tried.note = meets(goals_, truth_, *without) ? "without it the scene is no faster"
                                                       : "without it a goal is missed";
      }
      found_.effects.push_back(tried);
    }
  }

  const core::SceneFile& scene_;
  const std::vector<Goal>& goals_;
  const std::vector<Truth>& truth_;
  Candidate given_;
  Trials& trials_;
  Found found_{};
  const Trial* best_ = nullptr;
};

}  // namespace

Found search(const core::SceneFile& scene, const std::vector<Goal>& goals, const std::vector<Truth>& truth,
             const Candidate& given, Trials& trials) {
  return Search(scene, goals, truth, given, trials).run();
}

}  // namespace talus::tune
