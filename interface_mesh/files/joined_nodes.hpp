#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Numbers the corners of a file so that those at exactly the same place are one node, whatever solid,
/// object, group or material they stand in. Nothing else is joined.
class JoinedNodes {
 public:
  Index number(const core::Vector3& at);
  core::Vector3 operator[](Index node) const;
  /// 3 a node.
  std::vector<double> take_positions() { return std::move(positions_); }

 private:
  using Bits = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Bits& bits) const noexcept;
  };
  std::unordered_map<Bits, Index, Hash> numbers_;
  std::vector<double> positions_;
};

}  // namespace talus::mesh
