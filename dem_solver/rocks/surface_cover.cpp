#include "dem_solver/rocks/surface_cover.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "core/errors.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/rocks/surface_nodes.hpp"
#include "dem_solver/rocks/triangle_tree.hpp"

namespace talus::dem {

namespace {

constexpr double largest_radius = 1;      // of the spacing
constexpr double looks_the_same = 0.7;    // cosine
constexpr double pieces_a_spacing2 = 16;  // of a face

/// A small part of a face.
struct Piece {
  core::Vector3 middle, normal;  ///< m; unit vector outwards
  double area = 0;               ///< m^2
};

/// Halves the longest side until no piece is larger than `largest` (m^2).
void split(const std::array<core::Vector3, 3>& corners, double largest, std::vector<Piece>& pieces) {
  const auto& [a, b, c] = corners;
  const core::Vector3 twice = (b - a).cross(c - a);
  const double area = 0.5 * twice.norm();
  if (area <= largest) {
    if (area > 0) pieces.push_back({(a + b + c) / 3, twice / (2 * area), area});
    return;
  }
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  const auto [from, to, tip] = ab >= bc && ab >= ca ? std::array{a, b, c}
                               : bc >= ca           ? std::array{b, c, a}
                                                    : std::array{c, a, b};
  const core::Vector3 middle = 0.5 * (from + to);
  split({from, middle, tip}, largest, pieces);
  split({middle, to, tip}, largest, pieces);
}

std::vector<Piece> pieces_of(const mesh::Surface& surface, double spacing) {
  std::vector<Piece> pieces;
  for (const auto& t : surface.triangles)
    split({node(surface, t[0]), node(surface, t[1]), node(surface, t[2])},
          spacing * spacing / pieces_a_spacing2, pieces);
  return pieces;
}

/// Pieces that were chosen for a ball, found again by their place.
class Chosen {
 public:
  explicit Chosen(double spacing) : spacing_(spacing) {}

  void add(const Piece& piece) {
    at_[key(place(piece.middle))].push_back(static_cast<Index>(chosen_.size()));
    chosen_.push_back(piece);
  }
  std::span<const Piece> all() const { return chosen_; }

  /// The nearest one that looks the same way, within the spacing; -1: there is none.
  Index nearest(const Piece& piece) const {
    Index best = -1;
    double least = spacing_ * spacing_;
    const auto middle = place(piece.middle);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = at_.find(key({middle[0] + i, middle[1] + j, middle[2] + k}));
          if (found == at_.end()) continue;
          for (const Index n : found->second) {
            const double distance = (chosen_[n].middle - piece.middle).squaredNorm();
            if (distance >= least || chosen_[n].normal.dot(piece.normal) < looks_the_same) continue;
            least = distance;
            best = n;
          }
        }
    return best;
  }

 private:
  using Place = std::array<std::int64_t, 3>;
  Place place(const core::Vector3& p) const {
    const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(p[axis] / spacing_)); };
    return {along(0), along(1), along(2)};
  }
  static std::int64_t key(const Place& p) { return (p[0] * 2'097'143 + p[1]) * 2'097'143 + p[2]; }

  double spacing_;
  std::vector<Piece> chosen_;
  std::unordered_map<std::int64_t, std::vector<Index>> at_;
};

/// The largest ball that touches the surface at a piece from inside.
Ball inscribed(const TriangleTree& tree, const Piece& piece, double largest) {
  constexpr double round_off = 1e-9;
  const auto centre = [&](double radius) -> core::Vector3 { return piece.middle - radius * piece.normal; };
  std::int32_t hint = 0;
  const auto fits = [&](double radius) {
    const core::Vector3 c = centre(radius);
    return tree.distance({c.x(), c.y(), c.z()}, hint) >= radius * (1 - round_off);
  };
  double low = 0, high = largest;
  if (fits(high)) return {centre(high), high};
  for (int k = 0; k < 30; ++k) (fits(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  // Less than what touches another face beside an edge: it stands for one.
  constexpr double clear = 0.75;
  return {centre(clear * low), clear * low};
}

}  // namespace

SurfaceCover cover_with_spheres(const mesh::Surface& surface, const CoverGoal& goal) {
  const std::vector<Piece> pieces = pieces_of(surface, goal.spacing);
  Chosen chosen(goal.spacing);
  for (const Piece& piece : pieces) {
    if (chosen.nearest(piece) < 0) chosen.add(piece);
    if (chosen.all().size() > goal.most_balls)
      throw core::ConfigError(
          fmt::format("covering the rock at a spacing of {:.4g} m takes more than {} spheres: "
                      "the spacing must be larger",
                      goal.spacing, goal.most_balls));
  }
  const TriangleTree tree(surface);
  SurfaceCover cover;
  for (const Piece& piece : chosen.all()) {
    cover.balls.push_back(inscribed(tree, piece, largest_radius * goal.spacing));
    cover.facing.push_back(piece.normal);
  }
  cover.areas.resize(cover.balls.size());
  for (const Piece& piece : pieces) cover.areas[chosen.nearest(piece)] += piece.area;
  cover.deviation = largest_gap(cover.balls, surface);
  return cover;
}

std::vector<double> shown_areas(std::span<const Ball> balls) {
  constexpr int points = 2000;
  std::vector<double> areas;
  for (const Ball& ball : balls) {
    int outside = 0;
    for (int k = 0; k < points; ++k) {
      // Along a spiral from pole to pole whose turns are as far apart as its points: equal areas.
      const double z = 1 - (2 * k + 1.0) / points, turn = k * std::numbers::pi * (3 - std::sqrt(5.0)),
                   r = std::sqrt(1 - z * z);
      const core::Vector3 point =
          ball.centre + ball.radius * core::Vector3(r * std::cos(turn), r * std::sin(turn), z);
      outside += std::ranges::none_of(balls, [&](const Ball& other) {
        return &other != &ball && (point - other.centre).norm() < other.radius;
      });
    }
    areas.push_back(std::numbers::pi * ball.radius * ball.radius * outside / points);
  }
  return areas;
}

}  // namespace talus::dem
