#include "interface_mesh/net_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::mesh {

namespace {

double side(const RhombicPattern& net) {
  return std::hypot(net.diagonals[0], net.diagonals[1]) / 2;
}

double slanted_side(const HexagonalPattern& net) {
  return std::hypot(net.mesh_size[0], net.mesh_size[1] - net.twist_length) / 2;
}

double axis_radius(const RingPattern& net) {
  return (net.inner_diameter + net.bundle_diameter()) / 2;
}

/// Builds a ring's polygon node by node.
class RingCell {
 public:
  explicit RingCell(const RingPattern& net) : net_(net), radius_(axis_radius(net)) {
    const double half = net.inner_diameter / 2;
    half_chord_ = std::sqrt(radius_ * radius_ - half * half);
  }

  Lattice cell() {
    const double pitch = net_.inner_diameter, half = pitch / 2;
    lattice_.cell = {pitch, pitch};
    lattice_.parts = {{"ring", net_.bundle_diameter() / 2}};
    // The crossings with the neighbours on the right and above are this cell's, those on the left and below
    // are theirs.
    const Node right_low = add({pitch, half - half_chord_}), right_high = add({pitch, half + half_chord_});
    const Node top_right = add({half + half_chord_, pitch}), top_left = add({half - half_chord_, pitch});
    const Node left_high = of_neighbour(right_high, {-1, 0}), left_low = of_neighbour(right_low, {-1, 0});
    const Node bottom_left = of_neighbour(top_left, {0, -1}), bottom_right = of_neighbour(top_right, {0, -1});

    add_arc(bottom_right, right_low);
    add_apex(right_low, right_high, {half + radius_, half});
    add_arc(right_high, top_right);
    add_apex(top_right, top_left, {half, half + radius_});
    add_arc(top_left, left_high);
    add_apex(left_high, left_low, {half - radius_, half});
    add_arc(left_low, bottom_left);
    add_apex(bottom_left, bottom_right, {half, half - radius_});
    return std::move(lattice_);
  }

 private:
  struct Node {
    std::size_t index = 0;
    std::array<int, 2> step{};
  };

  Node add(const Vector2& at) {
    lattice_.nodes.push_back(at);
    return {lattice_.nodes.size() - 1, {0, 0}};
  }
  static Node of_neighbour(Node node, std::array<int, 2> step) { return {node.index, step}; }

  Vector2 position(const Node& node) const {
    return lattice_.nodes[node.index] + net_.inner_diameter * Vector2(node.step[0], node.step[1]);
  }

  void link(const Node& from, const Node& to) {
    lattice_.links.push_back(
        {from.index, to.index, {to.step[0] - from.step[0], to.step[1] - from.step[1]}, 0});
  }

  void add_apex(const Node& from, const Node& to, const Vector2& at) {
    const Node apex = add(at);
    link(from, apex);
    link(apex, to);
  }

  /// Counter-clockwise about the ring's centre.
  void add_arc(const Node& from, const Node& to) {
    const Vector2 centre = Vector2::Constant(net_.inner_diameter / 2);
    const Vector2 start = position(from) - centre, end = position(to) - centre;
    const double first = std::atan2(start.y(), start.x());
    const double angle = std::acos(std::clamp(start.dot(end) / (radius_ * radius_), -1.0, 1.0));
    Node before = from;
    for (int k = 1; k < RingPattern::arc_chords; ++k) {
      const double direction = first + angle * k / RingPattern::arc_chords;
      const Node here = add(centre + radius_ * Vector2(std::cos(direction), std::sin(direction)));
      link(before, here);
      before = here;
    }
    link(before, to);
  }

  const RingPattern& net_;
  double radius_ = 0, half_chord_ = 0;
  Lattice lattice_;
};

}  // namespace

double RingPattern::bundle_diameter() const {
  return wire_diameter * std::sqrt(windings * std::sqrt(12.0) / std::numbers::pi);
}

Lattice lattice(const SquarePattern& net) {
  return {.cell = {net.pitch, net.pitch},
          .nodes = {{0, 0}},
          .links = {{0, 0, {1, 0}}, {0, 0, {0, 1}}},
          .parts = {{"wire", net.wire_diameter / 2}}};
}

Lattice lattice(const RhombicPattern& net) {
  const auto [x, y] = net.diagonals;
  return {.cell = {x, y},
          .nodes = {{0, 0}, {x / 2, y / 2}},
          .links = {{0, 1, {0, 0}}, {1, 0, {1, 0}}, {1, 0, {0, 1}}, {1, 0, {1, 1}}},
          .parts = {{"wire", net.wire_diameter / 2}}};
}

Lattice lattice(const HexagonalPattern& net) {
  const auto [width, length] = net.mesh_size;
  const double twist = net.twist_length, rise = (length - twist) / 2;
  // Two rows of openings: a twist from 0 to 1, slanted to the twist from 2 to 3 half a mesh aside, slanted
  // back.
  return {.cell = {width, length + twist},
          .nodes = {{0, 0}, {0, twist}, {width / 2, twist + rise}, {width / 2, 2 * twist + rise}},
          .links = {{0, 1, {0, 0}, 1},
                    {2, 3, {0, 0}, 1},
                    {1, 2, {0, 0}, 0},
                    {2, 1, {1, 0}, 0},
                    {3, 0, {0, 1}, 0},
                    {3, 0, {1, 1}, 0}},
          .parts = {{"wire", net.wire_diameter / 2}, {"twist", net.wire_diameter, 2}}};
}

Lattice lattice(const RingPattern& net) {
  return RingCell(net).cell();
}

double opening(const SquarePattern& net) {
  return net.pitch - net.wire_diameter;
}

double opening(const RhombicPattern& net) {
  return net.diagonals[0] * net.diagonals[1] / (2 * side(net)) - net.wire_diameter;
}

double opening(const HexagonalPattern& net) {
  const auto [width, length] = net.mesh_size;
  const double to_twist = width / 2 - net.wire_diameter;
  const double to_slanted = width * length / (4 * slanted_side(net)) - net.wire_diameter / 2;
  return 2 * std::min(to_twist, to_slanted);
}

double opening(const RingPattern& net) {
  return net.inner_diameter - 2 * net.bundle_diameter();
}

double wire_length_per_area(const SquarePattern& net) {
  return 2 / net.pitch;
}

double wire_length_per_area(const RhombicPattern& net) {
  return 4 * side(net) / (net.diagonals[0] * net.diagonals[1]);
}

double wire_length_per_area(const HexagonalPattern& net) {
  const double area = net.mesh_size[0] * (net.mesh_size[1] + net.twist_length) / 2;
  return (2 * net.twist_length + 2 * slanted_side(net)) / area;
}

double wire_length_per_area(const RingPattern& net) {
  const double length = 2 * std::numbers::pi * axis_radius(net) * net.windings;
  return length / (net.inner_diameter * net.inner_diameter);
}

}  // namespace talus::mesh
