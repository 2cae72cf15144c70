#pragma once

#include <algorithm>
#include <utility>

#include "coupler/schemes/convergence.hpp"

namespace talus::coupler {

/// A strong scheme: a window is repeated from its start until both sides agree on forces and motion.
///
///     save;  x = prediction;  H(x);  while not converged:  x = acceleration(x, H(x)),  restore,  H(x)
///
/// `Unknown` says what x is and in which order the sides run (unknowns.hpp), `Acceleration` how x goes on
/// (acceleration/).
template <class Unknown, class Acceleration>
class Implicit {
 public:
  Implicit(Unknown unknown, Acceleration acceleration, const Convergence& convergence, Predictor predictor)
      : unknown_(std::move(unknown)),
        acceleration_(std::move(acceleration)),
        convergence_(convergence),
        predictor_(predictor) {}

  void compute(Exchange& exchange, const Window& window) {
    exchange.save_states(window);
    unknown_.predict(window, predictor_);
    acceleration_.begin_window();
    int iteration = 0;
    unknown_.evaluate(window, iteration);
    auto verdict = convergence_.judge(unknown_.changes(window));
    while (!verdict.converged() && ++iteration < convergence_.most_iterations) {
      correct(exchange);
      exchange.restore_states(window);
      unknown_.evaluate(window, iteration);
      verdict = convergence_.judge(unknown_.changes(window));
    }
    if (!verdict.converged() && convergence_.fail_otherwise) fail_not_converged(window, iteration, verdict);
    exchange.accept_window();
    count(iteration, verdict.converged());
  }
  const IterationTally& tally() const { return tally_; }
  /// What later windows depend on: the unknown is predicted anew in each window, the acceleration remembers.
  void archive(core::StateArchive& archive) {
    acceleration_.archive(archive);
    tally_.archive(archive);
  }

 private:
  void correct(const Exchange& exchange) {
    if (exchange.touching()) {
      acceleration_.update(unknown_.x(), unknown_.made());
    } else {
      // Without forces the sides do not hear of each other: what they made is the fixed point, unless they
      // touch there.
      std::copy(unknown_.made().begin(), unknown_.made().end(), unknown_.x().begin());
    }
  }
  void count(int iteration, bool converged) {
    const int used = std::min(iteration + 1, convergence_.most_iterations);
    ++tally_.windows;
    tally_.iterations += used;
    tally_.most = std::max(tally_.most, used);
    if (!converged) ++tally_.not_converged;
  }

  Unknown unknown_;
  Acceleration acceleration_;
  Convergence convergence_;
  Predictor predictor_;
  IterationTally tally_;
};

}  // namespace talus::coupler
