#include "dem_solver/scene/overlap_check.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "dem_solver/collision/pair_list.hpp"

namespace talus::dem {

void check_overlaps(std::span<const SphereInput> input, const std::function<std::string(Index)>& name_of) {
  constexpr double tolerance = 1e-9;  // of the smaller radius: spheres written as touching
  if (input.empty()) return;
  Spheres spheres;
  spheres.add(input, {});
  PairList list;
  list.rebuild(spheres, {.skin = 0});
  double deepest = 0;
  std::string where;
  std::int64_t count = 0;
  const auto one = [&](Index i) {
    const Row& p = spheres.position[i];
    const std::string name = name_of ? name_of(spheres.id[i]) + " " : "";
    return fmt::format("{}at ({:.6g}, {:.6g}, {:.6g}) m", name, p.x, p.y, p.z);
  };
  const auto consider = [&](Index i, Index j) {
    const Row &p = spheres.position[i], &q = spheres.position[j];
    const double depth = p.w + q.w - length(triple<double>(p) - triple<double>(q));
    if (depth <= tolerance * std::min(p.w, q.w)) return;
    ++count;
    if (depth <= deepest) return;
    deepest = depth;
    where = one(i) + " and " + one(j);
  };
  for (Index i = 0; i < spheres.size(); ++i)
    for (Index slot = list.first()[i]; slot < list.first()[i + 1]; ++slot) consider(i, list.other()[slot]);
  for (const PairList::WidePair& pair : list.wide()) consider(pair.first, pair.second);
  if (count == 0) return;
  throw core::ConfigError(fmt::format(
      "{} pair(s) of spheres overlap at time 0; the deepest by {:.4g} m: spheres {}", count, deepest, where));
}

}  // namespace talus::dem
