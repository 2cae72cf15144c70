#include "coupler/report/doubles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/report/drawing.hpp"
#include "coupler/report/packed.hpp"

namespace talus::report {

namespace {

using core::FieldReader;
using core::GroupDescription;

/// The longest side of the box about some positions.
double size_of(const std::vector<double>& positions) {
  std::array<Range, 3> box = empty_box;
  for (std::size_t i = 0; i < positions.size(); ++i) box[i % 3].take(positions[i]);
  double size = 0;
  for (const Range& range : box) size = std::max(size, range.high - range.low);
  return size;
}

bool same(const FieldReader& fields, const GroupDescription& a, const GroupDescription& b) {
  if (a.kind != b.kind || a.nodes != b.nodes || a.cells != b.cells) return false;
  for (const std::int64_t frame : {std::int64_t{0}, fields.frames() / 2, fields.frames() - 1}) {
    const auto one = fields.read(a, "position", frame), other = fields.read(b, "position", frame);
    const double close = 1e-3 * size_of(one);
    if (!std::ranges::equal(one, other, [&](double x, double y) { return std::abs(x - y) <= close; }))
      return false;
  }
  return true;
}

}  // namespace

std::map<std::string, std::string> doubles(const FieldReader& fields) {
  std::map<std::string, std::string> found;
  std::vector<const GroupDescription*> ordered;
  for (const auto& group : fields.groups()) ordered.push_back(&group);
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const auto* group) { return has_field(*group, "displacement"); });
  std::vector<const GroupDescription*> drawn;
  for (const auto* group : ordered) {
    const auto below = std::ranges::find_if(
        drawn, [&](const GroupDescription* other) { return same(fields, *group, *other); });
    if (below == drawn.end() || has_field(*group, "displacement"))
      drawn.push_back(group);
    else
      found[group->name] = (*below)->name;
  }
  return found;
}

}  // namespace talus::report
