#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/study/values.hpp"

/// What a quantity is at a step of zero, from three runs, and how far that may be off.
namespace talus::study {

/// A quantity at one step; steps in the sweep's unit.
struct Sample {
  double step = 0;
  Values values;
};

/// The order of convergence p that three samples show, finest first with steps h1 < h2 < h3:
///
///     (q3 - q2) / (q2 - q1) = (h3^p - h2^p) / (h2^p - h1^p)
///
/// | symbol | meaning                                                          |
/// |--------|------------------------------------------------------------------|
/// | q      | a number; of histories the differences are root mean squares      |
/// | h      | its step                                                         |
///
/// The right side grows with p, from log(h3/h2) / log(h2/h1) at p = 0; with equal ratios r it is r^p. Nothing where
/// the left side is not above that: the samples do not approach a limit.
/// Test: "the order of three samples is that of the model they come from, also where their ratios differ".
std::optional<double> observed_order(const std::vector<Sample>& finest_first);

/// Richardson's extrapolation to a step of zero (L. F. Richardson, Phil. Trans. R. Soc. A 210, 1911):
///
///     q0 = q1 + (q1 - q2) / ((h2/h1)^p - 1)
///
/// Valid where the error is c h^p to leading order. Histories are extrapolated at each time of the finer run.
/// Test: "Richardson's extrapolation removes the leading error of single numbers and histories".
Values extrapolate(const Sample& fine, const Sample& coarse, double order);

/// A reference and how far it may be from the truth.
struct Limit {
  Values values;
  /// Relative to it: where trusted, as much as the extrapolation moved the finest sample; else the largest distance
  /// of all that is known of it (the samples, the extrapolation with the expected order) from the finest.
  double bar = 0;
  bool trusted = false;
  std::optional<double> order = {};  ///< observed
  std::string note;                  ///< why it is not trusted
  /// Between these it lies as far as is known; single numbers only.
  double low() const { return values.numbers.front() - reach(); }
  double high() const { return values.numbers.front() + reach(); }

 private:
  double reach() const;
};

/// How near the observed order must be to the expected one for a reference to be trusted, as a share of it.
inline constexpr double near_order = 0.3;
/// Samples that differ by less than this, relatively, are the same but for round-off.
inline constexpr double round_off = 1e-12;

/// The limit of samples, finest first. Trusted only where three of them show nearly the expected order, or do not
/// differ; the extrapolation then takes the order they show. Else it is the finest sample.
/// @pre at least one sample
Limit limit_of(const std::vector<Sample>& finest_first, double expected_order);

}  // namespace talus::study
