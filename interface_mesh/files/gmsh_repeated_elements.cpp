#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interface_mesh/files/gmsh_content.hpp"

namespace talus::mesh::gmsh {

namespace {

/// 1 where both run round the same way, -1 the opposite way, 0 where they are different elements.
int same_turn(const Element& a, const Element& b) {
  const std::size_t n = a.corners;
  for (std::size_t shift = 0; shift < n; ++shift) {
    bool forward = true, backward = true;
    for (std::size_t k = 0; k < n; ++k) {
      forward = forward && a.nodes[k] == b.nodes[(k + shift) % n];
      backward = backward && a.nodes[k] == b.nodes[(n - k + shift) % n];
    }
    // The opposite of a line is a shift, too.
    if (forward) return n == 2 && shift == 1 ? -1 : 1;
    if (backward) return -1;
  }
  return 0;
}

}  // namespace

void merge_repeated_elements(const Scanner& text, Content& content, bool once_a_group) {
  using Same = std::pair<Key, std::array<Number, 4>>;
  std::map<Same, std::size_t> places;
  std::vector<Element> kept;
  for (Element& element : content.elements) {
    std::array<Number, 4> sorted = element.nodes;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(element.corners));
    const auto [found, is_new] = places.emplace(Same{element.entity, sorted}, kept.size());
    if (is_new || element.kind == single_point) {
      kept.push_back(std::move(element));
      continue;
    }
    Element& first = kept[found->second];
    const int turn = same_turn(first, element);
    const bool other_group = !element.groups.empty() && !first.groups.empty() && once_a_group &&
                             std::none_of(first.groups.begin(), first.groups.end(), [&](Number group) {
                               return std::abs(group) == std::abs(element.groups[0]);
                             });
    if (turn == 0 || !other_group)
      text.fail_at(element.line,
                   fmt::format("an element is there twice: its nodes are those of line {}", first.line));
    first.groups.push_back(turn * element.groups[0]);
  }
  content.elements = std::move(kept);
}

}  // namespace talus::mesh::gmsh
