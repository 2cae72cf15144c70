#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/output/checkpoint.hpp"
#include "coupler/schemes/convergence.hpp"

namespace talus::coupler {

/// A strong scheme: a window is repeated from its start until both sides agree on forces and motion.
///
///     save;  x = prediction;  H(x);  while not converged:  x = acceleration(x, H(x)),  restore,  H(x)
///
/// `Unknown` says what x is and in which order the sides run (unknowns.hpp), `Acceleration` how x goes on
/// (acceleration/).
///
/// Where the scene allows it, a window that does not converge is taken back and computed as two halves. What
/// stops the iteration is the gain k L^2 / 4 m of a contact on a node, so half the length has a quarter of
/// it. A window more than twice as long as the last one that was tried is halved unasked: a contact that asks
/// for short windows asks again in the next one, and the length finds its way back once it does not.
template <class Unknown, class Acceleration>
class Implicit {
 public:
  Implicit(Unknown unknown, Acceleration acceleration, const Convergence& convergence, Predictor predictor)
      : unknown_(std::move(unknown)),
        acceleration_(std::move(acceleration)),
        convergence_(convergence),
        predictor_(predictor) {}

  void compute(Exchange& exchange, const Window& window) {
    const bool is_worth_trying = window.halvings + 1 >= halvings_ || !may_be_halved(window);
    if (is_worth_trying && settle(exchange, window)) return;
    for (const Window& half : window.halves()) compute(exchange, half);
  }
  const IterationTally& tally() const { return tally_; }
  /// What later windows depend on: the unknown is predicted anew in each window, the acceleration remembers.
  void archive(core::StateArchive& archive) {
    acceleration_.archive(archive);
    tally_.archive(archive);
    archive.count("halvings", halvings_);
  }

 private:
  bool may_be_halved(const Window& window) const { return window.halvings < convergence_.most_halvings; }

  /// @returns whether the window is done; else it is taken back
  bool settle(Exchange& exchange, const Window& window) {
    if (window.halvings != halvings_) acceleration_.forget();  // L is part of what it has learnt
    halvings_ = window.halvings;
    const Outcome outcome = iterate(exchange, window);
    tally_.iterations += outcome.iterations;
    if (!outcome.verdict.converged() && may_be_halved(window)) {
      exchange.take_back(window);
      ++tally_.halved;
      return false;
    }
    const bool may_go_on = !convergence_.fail_otherwise && std::isfinite(outcome.verdict.ratio);
    if (!outcome.verdict.converged() && !may_go_on)
      fail_not_converged(window, outcome.iterations, outcome.verdict);
    if (!outcome.verdict.converged()) acceleration_.forget();  // what was learnt in it misleads
    exchange.accept_window();
    count(window, outcome, exchange.touching());
    return true;
  }

  struct Outcome {
    int iterations = 0;
    Convergence::Verdict verdict;
  };
  Outcome iterate(Exchange& exchange, const Window& window) {
    exchange.save_states(window);
    unknown_.predict(window, predictor_);
    acceleration_.begin_window();
    Outcome outcome;
    double least = std::numeric_limits<double>::infinity();
    while (true) {
      unknown_.evaluate(window, outcome.iterations);
      outcome.verdict = convergence_.judge(unknown_.changes(window));
      ++outcome.iterations;
      if (outcome.verdict.converged() || outcome.iterations == convergence_.most_iterations) return outcome;
      if (!std::isfinite(outcome.verdict.ratio)) return outcome;  // no iteration leads back from there
      least = std::min(least, outcome.verdict.ratio);
      if (may_be_halved(window) && outcome.verdict.ratio > hopeless * least) return outcome;
      correct(exchange);
      exchange.restore_states(window);
    }
  }

  /// A change so many times the smallest of the window does not shrink again within its iterations, but may
  /// grow until a solver refuses the numbers it leads to.
  static constexpr double hopeless = 1e6;

  void correct(const Exchange& exchange) {
    if (exchange.touching()) {
      acceleration_.update(unknown_.x(), unknown_.made());
    } else {
      // Without forces the sides do not hear of each other: what they made is the fixed point, unless they
      // touch there.
      std::copy(unknown_.made().begin(), unknown_.made().end(), unknown_.x().begin());
      acceleration_.step_aside();
    }
  }

  void count(const Window& window, const Outcome& outcome, bool in_contact) {
    ++tally_.windows;
    if (in_contact) {
      ++tally_.in_contact;
      tally_.most_in_contact = std::max<std::int64_t>(tally_.most_in_contact, outcome.iterations);
    }
    tally_.most = std::max<std::int64_t>(tally_.most, outcome.iterations);
    tally_.most_halvings = std::max(tally_.most_halvings, window.halvings);
    if (!outcome.verdict.converged()) ++tally_.not_converged;
  }

  Unknown unknown_;
  Acceleration acceleration_;
  Convergence convergence_;
  Predictor predictor_;
  IterationTally tally_;
  std::int64_t halvings_ = 0;  ///< of the window that was tried last
};

}  // namespace talus::coupler
