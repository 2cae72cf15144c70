#include "coupler/tune/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupler/accuracy/estimate.hpp"
#include "coupler/study/reference.hpp"

namespace talus::tune {
namespace {

/// Halvings beyond which round-off and the machine's patience end every way.
constexpr int most_halvings = 10, most_doublings = 2;
/// A way whose first runs all fail does not go with the scene.
constexpr int most_failed_halvings = 4;

/// The runs of one way, finest first.
using Samples = std::vector<study::Sample>;

struct Limit {
  double value = 0, bar = 0;
  std::optional<double> order{};
  std::string note{};
};

Limit limit_of(const Samples& finest_first) {
  const accuracy::Orders orders{1, 2};
  const double last = finest_first[0].values.numbers.front(), before = finest_first[1].values.numbers.front();
  const double change = std::abs(before - last);
  const auto range = [&](std::optional<double> order, std::string note) {
    return Limit{last, accuracy::safety_without_order * change / std::abs(last), order, std::move(note)};
  };
  if (change <= study::round_off * std::abs(last)) return {last, study::round_off};
  const auto order = study::observed_order(finest_first);
  if (!order) return range({}, "its runs do not approach a limit");
  if (!orders.fits(*order))
    return range(order, fmt::format("it shows order {:.2g}, not {}", *order, orders.text()));
  const double limit = study::extrapolate(finest_first[0], finest_first[1], *order).numbers.front();
  return {limit, std::abs(limit - last) / std::abs(limit), order};
}

/// A way to the truth, as far as it was gone.
class Way {
 public:
  Way(const std::vector<Goal>& goals, Candidate start, Trials& trials)
      : goals_(goals), start_(std::move(start)), trials_(trials) {}

  /// One halving more. @returns false where it cannot be made
  bool go_on() {
    const auto clock = accuracy::with_all(start_.clock, std::ldexp(1, -halvings_));
    if (!clock || halvings_ > most_halvings) return false;
    constexpr double of_the_last = 2.5;
    if (of_the_last * last_seconds_ > trials_.seconds_left()) return false;
    Candidate finer = start_;
    finer.clock = *clock;
    const Trial* trial = trials_.run(finer);
    if (trial == nullptr) return false;
    const double step = std::ldexp(1, -halvings_++);
    if (!trial->good) return samples_.empty() && halvings_ < most_failed_halvings;
    last_seconds_ = trial->least();
    samples_.resize(goals_.size());
    for (std::size_t g = 0; g < goals_.size(); ++g)
      samples_[g].insert(samples_[g].begin(),
                         {.step = step, .values = {{}, {value_of(goals_[g], trial->summary)}}});
    return true;
  }
  /// Once twice the steps, then four times: what a budget allows that has no room for a halving.
  bool go_back() {
    const auto clock = accuracy::with_all(start_.clock, std::ldexp(1, doublings_ + 1));
    if (!clock || doublings_ == most_doublings) return false;
    Candidate coarser = start_;
    coarser.clock = *clock;
    const Trial* trial = trials_.run(coarser);
    if (trial == nullptr || !trial->good || samples_.empty()) return false;
    const double step = std::ldexp(1, ++doublings_);
    for (std::size_t g = 0; g < goals_.size(); ++g)
      samples_[g].push_back({.step = step, .values = {{}, {value_of(goals_[g], trial->summary)}}});
    return true;
  }
  bool is_known() const { return !samples_.empty() && samples_[0].size() >= 3; }
  Limit limit(std::size_t goal) const { return limit_of(samples_[goal]); }

 private:
  const std::vector<Goal>& goals_;
  Candidate start_;
  Trials& trials_;
  std::vector<Samples> samples_;  ///< of each goal
  int halvings_ = 0, doublings_ = 0;
  double last_seconds_ = 0;
};

/// Until every goal is known well enough.
void walk(Way& way, const std::vector<Goal>& goals, const std::function<bool(std::size_t goal)>& is_enough) {
  while (way.go_on()) {
    if (!way.is_known()) continue;
    bool enough = true;
    for (std::size_t g = 0; g < goals.size(); ++g) enough &= goals[g].is_energy() || is_enough(g);
    if (enough) return;
  }
  while (!way.is_known() && way.go_back()) {
  }
}

double relative(double a, double b) {
  return std::abs(a - b) / std::abs(b);
}

Truth first_truth(const Way& way, std::size_t goal) {
  const Limit limit = way.limit(goal);
  return {.value = limit.value,
          .bar = limit.bar,
          .order = limit.order,
          .way = "the scene as given",
          .second_way = {},
          .note = limit.note};
}

/// The better known of both, known to what they differ.
void hold_against(Truth& truth, const Limit& second, const std::string& name) {
  truth.second_way = name;
  truth.differs = relative(second.value, truth.value);
  if (second.bar < truth.bar) {
    truth.value = second.value;
    truth.bar = second.bar;
    truth.order = second.order;
    truth.note = second.note;
    std::swap(truth.way, truth.second_way);
  }
  truth.bar = std::max(truth.bar, *truth.differs);
}

}  // namespace

std::optional<std::vector<Truth>> find_truth(const std::vector<Goal>& goals, const Candidate& given,
                                             const std::vector<Change>& other_ways, Trials& trials) {
  Way first(goals, given, trials);
  const auto sharp = [&](std::size_t g, double bar) { return bar <= goals[g].share / sharper_than_goal; };
  walk(first, goals, [&](std::size_t g) { return sharp(g, first.limit(g).bar); });
  if (!first.is_known()) return std::nullopt;
  std::vector<Truth> truth;
  for (std::size_t g = 0; g < goals.size(); ++g)
    truth.push_back(goals[g].is_energy() ? Truth{.way = "the balance of energy", .second_way = {}}
                                         : first_truth(first, g));
  for (const auto& change : other_ways) {
    Way second(goals, given.with(change), trials);
    walk(second, goals, [&](std::size_t g) {
      return sharp(g, std::max(second.limit(g).bar, relative(second.limit(g).value, truth[g].value)));
    });
    if (!second.is_known()) continue;
    for (std::size_t g = 0; g < goals.size(); ++g)
      if (!goals[g].is_energy()) hold_against(truth[g], second.limit(g), change.name);
    return truth;
  }
  for (auto& one : truth)
    if (one.note.empty() && one.value != 0) one.note = "no second way to it ended";
  return truth;
}

double error_of(const Goal& goal, const Truth& truth, const nlohmann::json& summary) {
  const double value = value_of(goal, summary);
  if (goal.is_energy()) return std::abs(value);
  return relative(value, truth.value) + truth.bar;
}

bool meets(const std::vector<Goal>& goals, const std::vector<Truth>& truth, const Trial& trial) {
  if (!trial.good) return false;
  for (std::size_t g = 0; g < goals.size(); ++g)
    if (!(error_of(goals[g], truth[g], trial.summary) <= goals[g].share)) return false;
  return true;
}

}  // namespace talus::tune
