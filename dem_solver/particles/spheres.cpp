#include "dem_solver/particles/spheres.hpp"

#include <algorithm>

namespace talus::dem {

void Spheres::add(std::span<const SphereInput> input, const Wanted& wanted) {
  const bool has_rocks = std::ranges::any_of(input, [](const SphereInput& s) { return s.rock >= 0; });
  for (const SphereInput& sphere : input) {
    id.push_back(size());
    position.push_back(row(sphere.position, sphere.radius));
    velocity.push_back(row(sphere.velocity, sphere.mass));
    material.push_back(sphere.material);
    if (wanted.rotation) spin.push_back(row(sphere.spin));
    if (wanted.facing) facing.push_back(row(sphere.facing, sphere.area));
    if (has_rocks) rock.push_back(sphere.rock);
  }
  force.resize(position.size());
  if (wanted.rotation) torque.resize(position.size());
}

void Spheres::clear_loads(core::Block run) noexcept {
  const auto clear = [run](std::vector<Row>& rows) {
    for (Row& row : std::span(rows.data() + run.begin, rows.data() + run.end)) store(row, Lanes{});
  };
  clear(force);
  if (rotates()) clear(torque);
}

namespace {
template <class T>
void permute(std::vector<T>& values, std::span<const Index> order) {
  if (values.empty()) return;
  std::vector<T> moved(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) moved[i] = values[order[i]];
  values.swap(moved);
}
}  // namespace

void Spheres::reorder(std::span<const Index> order) {
  permute(position, order);
  permute(velocity, order);
  permute(spin, order);
  permute(force, order);
  permute(torque, order);
  permute(material, order);
  permute(id, order);
  permute(rock, order);
  permute(facing, order);
}

std::vector<Index> Spheres::places() const {
  std::vector<Index> place(id.size());
  for (Index i = 0; i < size(); ++i) place[id[i]] = i;
  return place;
}

}  // namespace talus::dem
