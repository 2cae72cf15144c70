#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/vector3.hpp"
#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// The forces that come through the interface, set before every window. Few nodes are touched at a time;
/// steps look at these alone.
class InterfaceForce {
 public:
  InterfaceForce() = default;
  /// @param nodes the structure's nodes that can be touched; none in a run on its own
  explicit InterfaceForce(std::vector<Index> nodes) : nodes_(std::move(nodes)), force_(3 * nodes_.size()) {
    touched_.reserve(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      in_order_ = in_order_ && nodes_[k] == static_cast<Index>(k);
  }

  const std::vector<Index>& nodes() const noexcept { return nodes_; }

  /// Values of nodes() in turn (3 a node) out of those of all nodes.
  void pick(std::span<const double> of_all, std::span<double> of_interface) const noexcept {
    if (in_order_) {
      std::copy_n(of_all.begin(), of_interface.size(), of_interface.begin());
      return;
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      core::Vector3::Map(&of_interface[3 * k]) = core::Vector3::Map(&of_all[3 * nodes_[k]]);
  }

  /// @param force N, 3 for each of nodes() in turn
  void set(std::span<const double> force) noexcept {
    std::ranges::copy(force, force_.begin());
    touched_.clear();
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (force_[3 * k] != 0 || force_[3 * k + 1] != 0 || force_[3 * k + 2] != 0) touched_.push_back(k);
  }

  bool touched() const noexcept { return !touched_.empty(); }
  /// visit(node, force in N) for every node whose force is not zero.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const std::size_t k : touched_) visit(nodes_[k], core::Vector3::Map(&force_[3 * k]));
  }

 private:
  std::vector<Index> nodes_;
  std::vector<double> force_;         ///< N
  std::vector<std::size_t> touched_;  ///< places in nodes_
  bool in_order_ = true;              ///< nodes_ are the structure's first ones
};

}  // namespace talus::fem
