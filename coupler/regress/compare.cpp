#include "coupler/regress/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace talus::coupler::regress {
namespace {

/// Columns of one family share their scale.
std::string family(const std::string& column) {
  if (column.ends_with("_J")) return "energies";
  for (const char* axis : {"_x_", "_y_", "_z_"}) {
    const auto place = column.rfind(axis);
    if (place != std::string::npos) return column.substr(0, place) + "_*_" + column.substr(place + 3);
  }
  return column;
}

std::vector<double> allowed_distances(const Table& baseline, const RegressionScene& tolerances) {
  std::map<std::string, double> scales;
  for (std::size_t i = 0; i < baseline.columns.size(); ++i) {
    double& scale = scales[family(baseline.columns[i])];
    for (const auto& row : baseline.rows) scale = std::max(scale, std::abs(row[i]));
  }
  std::vector<double> allowed;
  for (const auto& column : baseline.columns) {
    const auto own = std::ranges::find_if(tolerances.columns, [&](const ColumnScene& entry) {
      return column.find(entry.contains) != std::string::npos;
    });
    const double relative = own == tolerances.columns.end() ? tolerances.relative : own->relative;
    allowed.push_back(relative * scales[family(column)] + tolerances.absolute);
  }
  return allowed;
}

std::string mismatch(const Table& baseline, const Table& result) {
  for (const auto& column : baseline.columns) {
    if (std::ranges::count(result.columns, column) == 0) return "the column " + column + " is gone";
  }
  for (const auto& column : result.columns) {
    if (std::ranges::count(baseline.columns, column) == 0) return "the column " + column + " is new";
  }
  if (baseline.columns != result.columns) return "the columns stand in another order";
  if (baseline.rows.size() == result.rows.size()) return {};
  return fmt::format("{} rows instead of {}", result.rows.size(), baseline.rows.size());
}

double ratio(const Difference& d) {
  const double distance = std::abs(d.found - d.expected);
  if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
  if (distance == 0) return 0;
  return distance / d.allowed;
}

}  // namespace

std::string text(const Difference& d) {
  return fmt::format("{} differs first at {:g} s: expected {:.9g}, found {:.9g}, allowed {:.2g}", d.column,
                     d.time, d.expected, d.found, d.allowed);
}

Comparison compare(const Table& baseline, const Table& result, const RegressionScene& tolerances) {
  Comparison comparison{.mismatch = mismatch(baseline, result), .first = {}, .worst_column = {}};
  if (!comparison.mismatch.empty()) return comparison;
  const auto allowed = allowed_distances(baseline, tolerances);
  for (std::size_t r = 0; r < baseline.rows.size(); ++r) {
    for (std::size_t c = 0; c < baseline.columns.size(); ++c) {
      const Difference here{baseline.columns[c], baseline.rows[r][0], baseline.rows[r][c], result.rows[r][c],
                            allowed[c]};
      const double out = ratio(here);
      if (out > comparison.worst) {
        comparison.worst = out;
        comparison.worst_column = here.column;
      }
      const bool earliest =
          !comparison.first || (comparison.first->time == here.time && out > ratio(*comparison.first));
      if (out > 1 && earliest) comparison.first = here;
    }
  }
  return comparison;
}

}  // namespace talus::coupler::regress
