#include "dem_solver/output/gates.hpp"

#include <algorithm>

namespace talus::dem {

namespace {

double height_behind(const Gate& gate, const Triple<double>& point) noexcept {
  return dot(point - gate.point, gate.normal);
}

}  // namespace

Gates::Stone Gates::sphere(const Spheres& spheres, Index i) noexcept {
  return {.number = spheres.id[i],
          .name = spheres.id[i],
          .centre = triple<double>(spheres.position[i]),
          .velocity = triple<double>(spheres.velocity[i]),
          .mass = spheres.velocity[i].w,
          .radius = spheres.position[i].w};
}

Gates::Stone Gates::rock(const Stones& stones, Index k) noexcept {
  const Rocks& rocks = stones.rocks;
  return {.number = stones.spheres.size() + k,
          .name = rocks.first_sphere(k),
          .centre = rocks.centre(k),
          .velocity = rocks.velocity(k),
          .mass = rocks.mass(k),
          .radius = rocks.radius(k)};
}

void Gates::watch_all(const Stones& stones, double reach) {
  const Spheres& spheres = stones.spheres;
  spheres_ = spheres.size();
  side_.resize(gates_.size() * static_cast<std::size_t>(spheres_ + stones.rocks.size()), Side::unknown);
  for (std::size_t gate = 0; gate < gates_.size(); ++gate) {
    near_[gate].clear();
    for (Index i = 0; i < spheres_; ++i) {
      if (spheres.in_rock(i)) continue;
      const Stone stone = sphere(spheres, i);
      look(gate, stone, stones.time);
      if (holds(gate, stone.number) && std::abs(height_behind(gates_[gate], stone.centre)) <= reach)
        near_[gate].push_back(i);
    }
    for (Index k = 0; k < stones.rocks.size(); ++k) look(gate, rock(stones, k), stones.time);
  }
}

void Gates::watch_near(const Stones& stones) {
  for (std::size_t gate = 0; gate < gates_.size(); ++gate) {
    for (Index i : near_[gate]) look(gate, sphere(stones.spheres, i), stones.time);
    for (Index k = 0; k < stones.rocks.size(); ++k) look(gate, rock(stones, k), stones.time);
  }
}

void Gates::look(std::size_t gate, const Stone& stone, double time) {
  Side& side = side_[slot(gate, stone.number)];
  if (side == Side::behind) return;
  const Gate& at = gates_[gate];
  const double height = height_behind(at, stone.centre);
  if (height <= 0) {
    side = Side::in_front;
    return;
  }
  const bool passes =
      side == Side::in_front && length(stone.centre - at.point - height * at.normal) <= at.radius;
  // Past the disc's rim or behind it from the start: it may come again.
  side = passes ? Side::behind : Side::unknown;
  if (!passes) return;
  const double along = dot(stone.velocity, at.normal);  // negative where a contact has turned it since
  pass(gate, stone,
       {.time = along > 0 ? time - height / along : time,
        .stone = stone.name,
        .diameter = 2 * stone.radius,
        .speed = length(stone.velocity)});
}

void Gates::pass(std::size_t gate, const Stone& stone, const Passage& passage) {
  passages_[gate].push_back(passage);
  Passed& passed = passed_[gate];
  const bool first = passed.stones == 0;
  ++passed.stones;
  passed.mass += stone.mass;
  passed.kinetic_energy += 0.5 * stone.mass * dot(stone.velocity, stone.velocity);
  passed.smallest_radius = first ? stone.radius : std::min(passed.smallest_radius, stone.radius);
  passed.largest_radius = std::max(passed.largest_radius, stone.radius);
}

}  // namespace talus::dem
