#pragma once

#include <optional>
#include <string>

#include "coupler/regress/regression.hpp"
#include "coupler/regress/table.hpp"

/// Whether two results are the same within the tolerances of a regression.
namespace talus::coupler::regress {

/// A value outside of its tolerance.
struct Difference {
  std::string column;
  double time = 0;  ///< s
  double expected = 0, found = 0;
  double allowed = 0;  ///< largest distance of the two
};
/// "net_centre.displacement_z_m differs first at 0.0125 s: expected -0.1, found -0.2, allowed 1e-07"
std::string text(const Difference& difference);

struct Comparison {
  std::string mismatch;             ///< why the tables cannot be compared at all; empty: they can
  std::optional<Difference> first;  ///< the earliest; of equal times the one farthest out
  std::string worst_column;
  double worst = 0;  ///< distance over allowed distance; at most 1 where nothing differs

  bool same() const { return mismatch.empty() && !first; }
};

/// Compares column by column and row by row; the first column is the time. A value that is not finite equals
/// nothing.
///
///     |found - expected| <= relative * scale + absolute
///
/// scale is the largest magnitude in the baseline of the column, of the vector it is a component of
/// ("..._x_m", "..._y_m",
/// "..._z_m"), or of all energies ("..._J"), so that the round-off of a component or ledger line near zero is
/// no difference.
Comparison compare(const Table& baseline, const Table& result, const RegressionScene& tolerances);

}  // namespace talus::coupler::regress
