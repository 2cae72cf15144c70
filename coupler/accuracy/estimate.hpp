#pragma once

#include <optional>
#include <string>
#include <vector>

/// How far a number of a run may be from its limit at a step (or window, or mesh) of zero, told from
/// companions of the run at other steps.
namespace talus::accuracy {

/// A number at a step; the step over that of the run, so that the run itself has 1.
struct Sample {
  double size = 1;
  double value = 0;
};

/// Orders of convergence that theory gives: between that of the worst term and that of the best.
struct Orders {
  double low = 1, high = 2;
  bool fits(double order) const;
  std::string text() const;  ///< "2" or "1 to 2"
};

struct Estimate {
  enum class Kind {
    bar,     ///< the truth lies within value -+ below, above, which are equal
    range,   ///< the order seen is not the one expected: the truth lies between, as far as is known
    unknown  ///< no companion succeeded
  };
  Kind kind = Kind::unknown;
  double below = 0, above = 0;    ///< in the unit of the value, positive
  std::optional<double> order{};  ///< observed, where three runs tell
  std::string note{};             ///< why it is no bar, or what was not checked
};

/// Roache's factors of safety on Richardson's error: of three runs that show the expected order, and of what
/// shows none (P. J. Roache, J. Fluids Eng. 116, 1994, section 4).
inline constexpr double safety = 1.25, safety_without_order = 3;
/// Of the value: changes below it are round-off and the tolerances of iterations; they show no order.
inline constexpr double unresolved = 1e-6;

/// The error of the sample of size 1.
///
/// With three sizes h1 < h2 < h3 the order p comes from study::observed_order and the limit from Richardson:
///
///     q0 = q1 + (q1 - q2) / ((h2/h1)^p - 1)        bar = safety |q(1) - q0|
///
/// where p is the observed order, at most the highest expected one. With two sizes the order is the lowest
/// expected one and the factor that of an order that was not checked. Where the order is not expected: the
/// range of all values and safety_without_order times the change between the two finest on both sides of the
/// finest. Of more than three samples the three finest count. Test: "bars contain the truth where the error
/// is C h^p".
/// @pre a sample of size 1 is among them, and at most two are finer
Estimate estimate(std::vector<Sample> samples, const Orders& expected);

/// How far the largest of a curve may lie above the largest of its rows: by the parabola through that row and
/// its two neighbours f- f0 f+, whose vertex is at most |f- - 2 f0 + f+|/8 above f0, as f0 is the largest of
/// the three. 0 where the largest is the first or the last row. @param values of the rows, evenly spaced
double between_rows(const std::vector<double>& values);

}  // namespace talus::accuracy
