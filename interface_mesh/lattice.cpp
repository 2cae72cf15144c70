#include "interface_mesh/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

constexpr Index none = -1;
/// Ends this close to an edge, relative to the lengths, lie on it.
constexpr double round_off = 1e-9;

struct Box {
  Vector2 low, high;
};

Box bounding_box(const Polygon& outline) {
  Box box{outline.front(), outline.front()};
  for (const auto& corner : outline) {
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

double shortest_link(const Lattice& lattice) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& link : lattice.links) {
    const Vector2 step(link.step[0] * lattice.cell.x(), link.step[1] * lattice.cell.y());
    shortest = std::min(shortest, (lattice.nodes[link.to] + step - lattice.nodes[link.from]).norm());
  }
  return shortest;
}

/// Where the segment p-q crosses edges of the outline, as shares of its length, in order and with 0 and 1.
std::vector<double> cuts(const Polygon& outline, const Vector2& p, const Vector2& q) {
  std::vector<double> shares{0, 1};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vector2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    const double before = turn(a, b, p), after = turn(a, b, q);
    const double on_edge = round_off * (b - a).norm() * (q - p).norm();
    if (before * after >= 0 || std::abs(before) <= on_edge || std::abs(after) <= on_edge) continue;
    const double share = before / (before - after);
    const Vector2 crossing = p + share * (q - p);
    if ((crossing - a).dot(crossing - b) <= 0) shares.push_back(share);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

/// Cuts a lattice to a panel, cell by cell.
class Clipping {
 public:
  Clipping(const Lattice& lattice, const Panel& panel)
      : lattice_(lattice),
        panel_(panel),
        box_(bounding_box(panel.outline)),
        snap_(snap_of_link * shortest_link(lattice)) {
    // One cell more on each side: links reach into their neighbours.
    for (int axis = 0; axis < 2; ++axis)
      cells_[static_cast<std::size_t>(axis)] =
          static_cast<Index>(std::ceil((box_.high - box_.low)[axis] / lattice.cell[axis] - 1e-9)) + 2;
    places_.resize(lattice.nodes.size() * static_cast<std::size_t>(cells_[0]) *
                   static_cast<std::size_t>(cells_[1]));
    place_nodes();
  }

  Net net() {
    Net net;
    for (std::size_t part = 0; part < lattice_.parts.size(); ++part) add_part(part, net.surface);
    if (net.surface.segments.empty())
      throw core::ConfigError(
          "no wire of the net is inside the panel: its openings are larger than the panel");
    for (const auto& at : positions_) append(net.surface.positions, panel_.place(at));
    net.node_sets = rim_sets(panel_, rim_, net.surface.node_count());
    return net;
  }

 private:
  /// A lattice node: where it is after snapping, whether on the outline, and its number once a wire needs it.
  struct Place {
    Vector2 at = Vector2::Zero();
    bool inside = false, on_outline = false;
    OutlinePoint outline;
    Index node = none;
  };

  Place& place(Index column, Index row, std::size_t node) {
    return places_[(static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_[0]) +
                    static_cast<std::size_t>(column)) *
                       lattice_.nodes.size() +
                   node];
  }

  void place_nodes() {
    for (Index row = 0; row < cells_[1]; ++row)
      for (Index column = 0; column < cells_[0]; ++column)
        for (std::size_t k = 0; k < lattice_.nodes.size(); ++k) {
          Place& here = place(column, row, k);
          here.at = box_.low + lattice_.nodes[k] +
                    Vector2((column - 1) * lattice_.cell.x(), (row - 1) * lattice_.cell.y());
          here.outline = closest_on_outline(panel_.outline, here.at);
          here.on_outline = here.outline.distance <= snap_;
          if (here.on_outline) here.at = here.outline.at;
          here.inside = here.on_outline || contains(panel_.outline, here.at);
        }
  }

  Index number(Place& of) {
    if (of.node == none) of.node = add_node(of.at, of.on_outline ? &of.outline : nullptr);
    return of.node;
  }

  Index add_node(const Vector2& at, const OutlinePoint* outline) {
    const auto node = static_cast<Index>(positions_.size());
    positions_.push_back(at);
    if (outline) rim_.push_back({node, outline->edge, outline->share});
    return node;
  }

  void add_part(std::size_t part, Surface& surface) {
    const LatticePart& pattern = lattice_.parts[part];
    SurfacePart range{.name = pattern.name, .wire_radius = pattern.wire_radius, .wires = pattern.wires};
    range.segment_begin = static_cast<Index>(surface.segments.size());
    for (Index row = 0; row < cells_[1]; ++row)
      for (Index column = 0; column < cells_[0]; ++column)
        for (const auto& link : lattice_.links) {
          const Index to_column = column + link.step[0], to_row = row + link.step[1];
          if (link.part != part || std::min(to_column, to_row) < 0 || to_column >= cells_[0] ||
              to_row >= cells_[1])
            continue;
          add_link(place(column, row, link.from), place(to_column, to_row, link.to), surface);
        }
    range.segment_end = static_cast<Index>(surface.segments.size());
    surface.parts.push_back(std::move(range));
  }

  /// Adds the pieces of a link that are inside.
  void add_link(Place& from, Place& to, Surface& surface) {
    const bool whole =
        from.inside && to.inside && !from.on_outline && !to.on_outline && !reaches_outline(from, to);
    if (whole) {
      surface.segments.push_back({number(from), number(to)});
      return;
    }
    const auto shares = cuts(panel_.outline, from.at, to.at);
    const double length = (to.at - from.at).norm();
    for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
      if ((shares[k + 1] - shares[k]) * length <= snap_) continue;
      const Vector2 middle = from.at + (shares[k] + shares[k + 1]) / 2 * (to.at - from.at);
      if (!contains(panel_.outline, middle) &&
          closest_on_outline(panel_.outline, middle).distance > round_off * length)
        continue;
      const Index start = end_of_piece(from, to, shares[k], length),
                  end = end_of_piece(from, to, shares[k + 1], length);
      surface.segments.push_back({start, end});
    }
  }

  /// A link between inner nodes can leave a concave outline only if its ends are nearer to the outline than
  /// its length.
  static bool reaches_outline(const Place& from, const Place& to) {
    return std::min(from.outline.distance, to.outline.distance) < (to.at - from.at).norm();
  }

  /// The node at a share of a link: one of its ends where it is as near as round-off, or a new one on the
  /// outline.
  Index end_of_piece(Place& from, Place& to, double share, double length) {
    if (share * length <= snap_ && from.inside) return number(from);
    if ((1 - share) * length <= snap_ && to.inside) return number(to);
    const OutlinePoint outline = closest_on_outline(panel_.outline, from.at + share * (to.at - from.at));
    return add_node(outline.at, &outline);
  }

  const Lattice& lattice_;
  const Panel& panel_;
  Box box_;
  double snap_ = 0;
  std::array<Index, 2> cells_{};
  std::vector<Place> places_;
  std::vector<Vector2> positions_;
  std::vector<RimNode> rim_;
};

}  // namespace

Net clip(const Lattice& lattice, const Panel& panel) {
  return Clipping(lattice, panel).net();
}

}  // namespace talus::mesh
