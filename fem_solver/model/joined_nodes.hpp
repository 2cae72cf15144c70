#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// Nodes in groups that grow together, each known by its lowest-numbered node (a disjoint-set forest).
class JoinedNodes {
 public:
  explicit JoinedNodes(std::size_t nodes) : towards_(nodes) {
    std::iota(towards_.begin(), towards_.end(), 0);
  }
  Index of(Index node) {
    auto& next = towards_[static_cast<std::size_t>(node)];
    while (next != towards_[static_cast<std::size_t>(next)]) next = towards_[static_cast<std::size_t>(next)];
    return next;
  }
  void join(Index a, Index b) {
    a = of(a), b = of(b);
    towards_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<Index> towards_;
};

}  // namespace talus::fem
