#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "interface_mesh/net.hpp"

namespace talus::mesh {

/// A group that lists a cell; `turned`: with its corners in the opposite order.
struct Listing {
  std::string group;
  bool turned = false;
  auto operator<=>(const Listing&) const = default;
};

/// Collects the cells of a file and the groups that list them, and makes a net of them: each cell stands in
/// it once, in the part of all cells that the same groups list, and in the cell set of each of its groups.
/// Parts come in the order of their first cells; of several groups they are named "one + other". Nodes that
/// neither a cell nor a node set uses are left out, the others keep their order.
class CellCollector {
 public:
  /// The groups of the cells that follow; none to begin with. The first one's direction is the net's.
  void list_in(const std::vector<Listing>& groups);

  void add_line(std::array<Index, 2> nodes);
  void add_triangle(std::array<Index, 3> nodes);
  /// Nodes stand in a set in the order they are added, each once.
  void add_to_node_set(const std::string& name, Index node);

  bool empty() const { return lines_.empty() && triangles_.empty(); }
  /// @param positions of the nodes by the numbers that the cells use; 3 a node
  Net net(const std::vector<double>& positions) const;

 private:
  template <std::size_t corners>
  struct Cell {
    std::size_t part;
    std::array<Index, corners> nodes;
  };
  std::size_t part_now();
  void add_cells(Net& net) const;
  void add_cell_sets(Net& net) const;
  std::vector<Index> used_nodes(std::size_t count) const;

  std::map<std::vector<Listing>, std::size_t> part_of_;
  std::vector<std::vector<Listing>> parts_;
  std::vector<Listing> listings_;
  std::size_t part_ = no_part;
  std::vector<Cell<2>> lines_;
  std::vector<Cell<3>> triangles_;
  std::vector<NodeSet> node_sets_;
  std::unordered_map<std::string, std::unordered_set<Index>> in_node_set_;

  static constexpr std::size_t no_part = static_cast<std::size_t>(-1);
};

}  // namespace talus::mesh
