#include "dem_solver/rocks/ball_union.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace talus::dem {

namespace {

/// Gauss' rule with six points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 3> gauss_point{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
constexpr std::array<double, 3> gauss_weight{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
constexpr int panels = 24;  ///< between two heights; the slices' area has square-root ends there

template <class Function>
void integrate(double low, double high, Function&& f) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (std::size_t k = 0; k < gauss_point.size(); ++k)
    for (double sign : {-1.0, 1.0}) f(middle + sign * half * gauss_point[k], half * gauss_weight[k]);
}

struct Disc {
  double x, y, radius;
};

struct PlaneMoments {
  double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

struct Arc {
  double begin, end;  ///< rad; counter-clockwise
};

/// The arcs of disc k that lie inside other discs, in [0, 2 pi).
std::vector<Arc> covered_arcs(const std::vector<Disc>& discs, std::size_t k) {
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<Arc> covered;
  const Disc& d = discs[k];
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == k) continue;
    const Disc& e = discs[j];
    const double dx = e.x - d.x, dy = e.y - d.y, distance = std::hypot(dx, dy);
    if (distance >= d.radius + e.radius) continue;
    const bool inside = distance + d.radius <= e.radius && (distance > 0 || d.radius < e.radius || j < k);
    if (inside) return {{0, turn}};
    if (distance + e.radius <= d.radius) continue;
    const double cosine =
        (d.radius * d.radius + distance * distance - e.radius * e.radius) / (2 * d.radius * distance);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    double begin = std::fmod(std::atan2(dy, dx) - half, turn);
    if (begin < 0) begin += turn;
    if (begin + 2 * half <= turn)
      covered.push_back({begin, begin + 2 * half});
    else {
      covered.push_back({begin, turn});
      covered.push_back({0, begin + 2 * half - turn});
    }
  }
  return covered;
}

std::vector<Arc> free_arcs(std::vector<Arc> covered) {
  std::ranges::sort(covered, {}, &Arc::begin);
  std::vector<Arc> arcs;
  double reached = 0;
  for (const Arc& arc : covered) {
    if (arc.begin > reached) arcs.push_back({reached, arc.begin});
    reached = std::max(reached, arc.end);
  }
  if (reached < 2 * std::numbers::pi) arcs.push_back({reached, 2 * std::numbers::pi});
  return arcs;
}

void add_arc(PlaneMoments& m, const Disc& d, const Arc& arc) {
  // Polynomials of degree four in sine and cosine: six points on a quarter turn are exact to round-off.
  const int pieces = static_cast<int>(std::ceil((arc.end - arc.begin) / (0.5 * std::numbers::pi)));
  const double length = (arc.end - arc.begin) / pieces;
  for (int p = 0; p < pieces; ++p)
    integrate(arc.begin + p * length, arc.begin + (p + 1) * length, [&](double angle, double weight) {
      const double c = std::cos(angle), s = std::sin(angle);
      const double x = d.x + d.radius * c, y = d.y + d.radius * s;
      const double dx = -d.radius * s * weight, dy = d.radius * c * weight;
      m.area += 0.5 * (x * dy - y * dx);
      m.x += 0.5 * x * x * dy;
      m.y -= 0.5 * y * y * dx;
      m.xx += x * x * x * dy / 3;
      m.yy -= y * y * y * dx / 3;
      m.xy += 0.5 * x * x * y * dy;
    });
}

PlaneMoments slice(std::span<const Ball> balls, double z) {
  std::vector<Disc> discs;
  for (const Ball& ball : balls) {
    const double height = z - ball.centre.z(), square = ball.radius * ball.radius - height * height;
    if (square > 0) discs.push_back({ball.centre.x(), ball.centre.y(), std::sqrt(square)});
  }
  PlaneMoments moments;
  for (std::size_t k = 0; k < discs.size(); ++k)
    for (const Arc& arc : free_arcs(covered_arcs(discs, k))) add_arc(moments, discs[k], arc);
  return moments;
}

/// Where a ball, or the circle that two balls share, begins and ends.
std::vector<double> critical_heights(std::span<const Ball> balls) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& a = balls[i];
    heights.push_back(a.centre.z() - a.radius);
    heights.push_back(a.centre.z() + a.radius);
    for (std::size_t j = 0; j < i; ++j) {
      const core::Vector3 apart = balls[j].centre - a.centre;
      const double distance = apart.norm();
      if (distance >= a.radius + balls[j].radius || distance <= std::abs(a.radius - balls[j].radius))
        continue;
      const double along =
          (a.radius * a.radius + distance * distance - balls[j].radius * balls[j].radius) / (2 * distance);
      const double radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
      const core::Vector3 axis = apart / distance, centre = a.centre + along * axis;
      const double half = radius * std::sqrt(std::max(0.0, 1 - axis.z() * axis.z()));
      heights.push_back(centre.z() - half);
      heights.push_back(centre.z() + half);
    }
  }
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

void add_slice(VolumeMoments& total, const PlaneMoments& m, double z, double weight) {
  total.volume += weight * m.area;
  total.first += weight * core::Vector3(m.x, m.y, z * m.area);
  Matrix3 second;
  second << m.xx, m.xy, z * m.x, m.xy, m.yy, z * m.y, z * m.x, z * m.y, z * z * m.area;
  total.second += weight * second;
}

}  // namespace

namespace {
VolumeMoments moments_of(const Ball& ball) {
  const double volume = 4.0 / 3 * std::numbers::pi * ball.radius * ball.radius * ball.radius;
  const Matrix3 central = 0.2 * ball.radius * ball.radius * Matrix3::Identity();
  return {volume, volume * ball.centre, volume * (central + ball.centre * ball.centre.transpose())};
}
}  // namespace

VolumeMoments union_moments(std::span<const Ball> balls) {
  if (balls.size() == 1) return moments_of(balls.front());
  VolumeMoments total;
  const std::vector<double> heights = critical_heights(balls);
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    // Panels thin out towards both ends like a cosine, which removes the square-root ends.
    const auto at = [&](int p) {
      return heights[k] + 0.5 * (heights[k + 1] - heights[k]) * (1 - std::cos(std::numbers::pi * p / panels));
    };
    for (int p = 0; p < panels; ++p)
      integrate(at(p), at(p + 1),
                [&](double z, double weight) { add_slice(total, slice(balls, z), z, weight); });
  }
  return total;
}

}  // namespace talus::dem
