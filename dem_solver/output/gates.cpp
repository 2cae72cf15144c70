#include "dem_solver/output/gates.hpp"

#include <algorithm>

namespace talus::dem {

void Gates::watch(const Spheres& spheres, const Rocks& rocks) {
  const auto stones = static_cast<std::size_t>(spheres.size()) + static_cast<std::size_t>(rocks.size());
  side_.resize(gates_.size() * stones, Side::unknown);
  for (std::size_t gate = 0; gate < gates_.size(); ++gate) {
    for (Index i = 0; i < spheres.size(); ++i)
      if (!spheres.in_rock(i))
        look(gate, stones,
             {spheres.id[i], triple<double>(spheres.position[i]), triple<double>(spheres.velocity[i]),
              spheres.velocity[i].w, spheres.position[i].w});
    for (Index k = 0; k < rocks.size(); ++k)
      look(gate, stones,
           {spheres.size() + k, rocks.centre(k), rocks.velocity(k), rocks.mass(k), rocks.radius(k)});
  }
}

void Gates::look(std::size_t gate, std::size_t stones, const Stone& stone) {
  Side& side = side_[gate * stones + static_cast<std::size_t>(stone.number)];
  if (side == Side::behind) return;
  const Gate& at = gates_[gate];
  const Triple<double> out = stone.centre - at.point;
  const double height = dot(out, at.normal);
  if (height <= 0) {
    side = Side::in_front;
    return;
  }
  const bool passes = side == Side::in_front && length(out - height * at.normal) <= at.radius;
  // Past the disc's rim or behind it from the start: it may come again.
  if (!passes) {
    side = Side::unknown;
    return;
  }
  side = Side::behind;
  Passed& passed = passed_[gate];
  const bool first = passed.stones == 0;
  ++passed.stones;
  passed.mass += stone.mass;
  passed.kinetic_energy += 0.5 * stone.mass * dot(stone.velocity, stone.velocity);
  passed.smallest_radius = first ? stone.radius : std::min(passed.smallest_radius, stone.radius);
  passed.largest_radius = std::max(passed.largest_radius, stone.radius);
}

}  // namespace talus::dem
