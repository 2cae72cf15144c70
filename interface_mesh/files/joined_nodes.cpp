#include "interface_mesh/files/joined_nodes.hpp"

#include <bit>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

std::size_t JoinedNodes::Hash::operator()(const Bits& bits) const noexcept {
  std::uint64_t mixed = 0;
  for (const std::uint64_t word : bits) {
    mixed = (mixed ^ word) * 0x9E3779B97F4A7C15u;
    mixed ^= mixed >> 32;
  }
  return static_cast<std::size_t>(mixed);
}

Index JoinedNodes::number(const core::Vector3& at) {
  // Adding 0 makes -0 the same place as 0.
  const core::Vector3 place = at.array() + 0.0;
  const Bits bits{std::bit_cast<std::uint64_t>(place.x()), std::bit_cast<std::uint64_t>(place.y()),
                  std::bit_cast<std::uint64_t>(place.z())};
  const auto [found, is_new] = numbers_.emplace(bits, static_cast<Index>(positions_.size() / 3));
  if (is_new) append(positions_, place);
  return found->second;
}

core::Vector3 JoinedNodes::operator[](Index node) const {
  return point(positions_, node);
}

}  // namespace talus::mesh
