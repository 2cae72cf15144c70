#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "interface_mesh/files/cell_collector.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/files/gmsh_content.hpp"

namespace talus::mesh {

namespace {

/// Gives the content the numbers of a surface.
class Assembly {
 public:
  explicit Assembly(const gmsh::Content& content) : content_(content) {
    for (const gmsh::Element& element : content_.elements)
      for (const gmsh::Number group : element.groups) used_groups_.insert(key_of(element, group));
    for (const gmsh::Number tag : content_.node_order) {
      index_[tag] = static_cast<Index>(positions_.size() / 3);
      const auto& at = content_.nodes.at(tag);
      positions_.insert(positions_.end(), at.begin(), at.end());
    }
  }

  Net net() {
    for (const gmsh::Element& element : content_.elements) add(element);
    return cells_.net(positions_);
  }

 private:
  static gmsh::Key key_of(const gmsh::Element& element, gmsh::Number group) {
    return {element.entity.first, std::abs(group)};
  }

  /// Groups without a name are called after their number; numbers are used anew for every dimension.
  std::string name_of(const gmsh::Key& group) const {
    const auto found = content_.group_names.find(group);
    if (found != content_.group_names.end()) return found->second;
    const auto unnamed_as_well = [&](gmsh::Number dimension) {
      const gmsh::Key other{dimension, group.second};
      return used_groups_.contains(other) && !content_.group_names.contains(other);
    };
    const bool alone = unnamed_as_well(0) + unnamed_as_well(1) + unnamed_as_well(2) == 1;
    constexpr std::array kinds{"points", "lines", "surfaces"};
    if (alone) return fmt::format("group_{}", group.second);
    return fmt::format("group_{}_of_{}", group.second, kinds[static_cast<std::size_t>(group.first)]);
  }

  void add(const gmsh::Element& element) {
    std::vector<Listing> listings;
    for (const gmsh::Number group : element.groups) {
      const std::string name = name_of(key_of(element, group));
      if (std::none_of(listings.begin(), listings.end(), [&](const Listing& l) { return l.group == name; }))
        listings.push_back({name, group < 0});
    }
    const auto node = [&](std::size_t k) { return index_.at(element.nodes[k]); };
    for (const Listing& listing : listings)
      for (std::size_t k = 0; k < element.corners; ++k) cells_.add_to_node_set(listing.group, node(k));
    if (element.kind == gmsh::single_point) return;
    if (listings != last_listings_) cells_.list_in(listings);
    last_listings_ = std::move(listings);
    if (element.kind == gmsh::line) return cells_.add_line({node(0), node(1)});
    cells_.add_triangle({node(0), node(1), node(2)});
    if (element.kind == gmsh::quadrangle) cells_.add_triangle({node(0), node(2), node(3)});
  }

  const gmsh::Content& content_;
  std::set<gmsh::Key> used_groups_;
  std::unordered_map<gmsh::Number, Index> index_;
  std::vector<double> positions_;
  std::vector<Listing> last_listings_;
  CellCollector cells_;
};

Net assemble(Scanner text) {
  const gmsh::Content content = gmsh::read(text);
  return Assembly(content).net();
}

}  // namespace

Net parse_gmsh(std::istream& text, const std::string& name) {
  std::ostringstream content;
  content << text.rdbuf();
  return assemble(Scanner(std::move(content).str(), name));
}

Net read_gmsh(const std::filesystem::path& path) {
  return assemble(Scanner::open(path));
}

}  // namespace talus::mesh
