#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "interface_mesh/files/scanner.hpp"

/// What stands in a Gmsh file, with the file's own numbers.
namespace talus::mesh::gmsh {

using Number = std::int64_t;

/// Gmsh's numbers of element kinds.
enum ElementKind : Number { line = 1, triangle = 2, quadrangle = 3, single_point = 15 };

/// A geometric entity or a physical group: its dimension and number.
using Key = std::pair<Number, Number>;

struct Element {
  ElementKind kind;
  Key entity;
  std::array<Number, 4> nodes{};
  std::size_t corners = 0;
  std::vector<Number> groups{};  ///< numbers of physical groups; negative: the group turns the element over
  int line = 0;                  ///< where it stands
};

struct Content {
  std::map<Key, std::string> group_names;
  std::unordered_map<Number, std::array<double, 3>> nodes;
  std::vector<Number> node_order;
  std::vector<Element> elements;  ///< each once, whatever number of groups it is listed in
};

/// Makes one element of those that the file lists once for each of their groups, as version 2.2 does.
/// @throws core::ConfigError for an element that is there twice otherwise
void merge_repeated_elements(const Scanner& text, Content& content, bool once_a_group);

/// @throws core::ConfigError as read_gmsh
Content read(Scanner& text);

}  // namespace talus::mesh::gmsh
