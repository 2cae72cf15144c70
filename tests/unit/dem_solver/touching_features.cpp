#include "dem_solver/boundary/touching_features.hpp"

#include <catch2/catch.hpp>
#include <random>

namespace talus::dem {
namespace {

/// Triangles over a grid of n x n cells of 1 m, heights as given.
template <class Height>
Boundary faces(int n, const Height& height) {
  mesh::Surface surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      surface.positions.insert(surface.positions.end(), {1.0 * i, 1.0 * j, height(i, j)});
  const auto at = [n](int i, int j) { return static_cast<mesh::Index>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  surface.parts = {{.name = "ground", .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  return Boundary(surface, std::vector<Index>{0});
}

/// Wires along the sides of the same cells.
template <class Height>
Boundary wires(int n, double radius, const Height& height) {
  mesh::Surface surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      surface.positions.insert(surface.positions.end(), {1.0 * i, 1.0 * j, height(i, j)});
  const auto at = [n](int i, int j) { return static_cast<mesh::Index>(i * (n + 1) + j); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      if (i < n) surface.segments.push_back({at(i, j), at(i + 1, j)});
      if (j < n) surface.segments.push_back({at(i, j), at(i, j + 1)});
    }
  surface.parts = {{.name = "net",
                    .wire_radius = radius,
                    .segment_end = static_cast<mesh::Index>(surface.segments.size())}};
  return Boundary(surface, std::vector<Index>{0});
}

std::vector<FeatureTouch> touches_of(const Boundary& boundary, const Triple<double>& centre, double radius,
                                     ContactRule rule = ContactRule::local_minima) {
  std::vector<Index> all;
  for (std::size_t k = 0; k < boundary.features().size(); ++k) all.push_back(static_cast<Index>(k));
  TouchSearch search(all.size());
  const auto found = search.find(boundary, row(centre, radius), all, rule);
  return {found.begin(), found.end()};
}

/// Of springs of stiffness 1 on the overlaps.
double energy(const Boundary& boundary, const Triple<double>& centre, double radius) {
  double sum = 0;
  for (const FeatureTouch& touch : touches_of(boundary, centre, radius))
    sum += 0.5 * (touch.reach - touch.distance) * (touch.reach - touch.distance);
  return sum;
}

Triple<double> force(const Boundary& boundary, const Triple<double>& centre, double radius) {
  Triple<double> sum;
  for (const FeatureTouch& touch : touches_of(boundary, centre, radius)) {
    const double f = touch.reach - touch.distance;
    sum = sum + f * touch.normal;
    if (touch.saddle.feature >= 0) sum = sum - f * touch.saddle.normal;
  }
  return sum;
}

double random_height(int i, int j) {
  std::mt19937 random(static_cast<unsigned>(100 * i + j));
  random.discard(3);
  return 0.6 * std::uniform_real_distribution<double>(-1, 1)(random);
}

}  // namespace

TEST_CASE(
    "The contacts' forces on a rough ground and on a net are the derivative of an energy without steps") {
  const bool of_wires = GENERATE(false, true);
  const Boundary boundary = of_wires ? wires(8, 0.05, random_height) : faces(8, random_height);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(2, 6), direction(-1, 1);
  const double radius = 1.2, h = 1e-6;
  int limited = 0, tried = 0;
  for (int n = 0; n < 400; ++n) {
    const Triple<double> centre{along(random), along(random), 1.0 + 0.4 * direction(random)};
    for (const FeatureTouch& touch : touches_of(boundary, centre, radius))
      limited += touch.saddle.feature >= 0;
    // Along a straight way the energy has no steps: between points h apart it changes by what the force says.
    const Triple<double> step{h * direction(random), h * direction(random), h * direction(random)};
    const double change =
        energy(boundary, centre + step, radius) - energy(boundary, centre - (1.0 * step), radius);
    const double work = -2 * dot(force(boundary, centre, radius), step);
    const double size = length(force(boundary, centre, radius)) * h;
    if (size == 0) continue;
    ++tried;
    CHECK(std::abs(change - work) < 1e-3 * size + 1e-15);
  }
  CHECK(tried > 200);
  CHECK(limited > 50);  // the case of saddles is among them
}

TEST_CASE("The energy changes without a step on a way over edges, corners and saddles") {
  const bool of_wires = GENERATE(false, true);
  const Boundary boundary = of_wires ? wires(8, 0.05, random_height) : faces(8, random_height);
  const double radius = 1.2, step = 1e-4;
  const Triple<double> from{2.1, 2.3, 1.0}, way{3.7, 3.1, 0.1};
  double last = energy(boundary, from, radius), largest = 0;
  for (double s = step; s < 1; s += step) {
    const double now = energy(boundary, from + s * way, radius);
    largest = std::max(largest, std::abs(now - last));
    last = now;
  }
  // Overlaps below 1 m, a handful of contacts: |dE/ds| < 5 x 4.8 m.
  CHECK(largest < 25 * step);
}

TEST_CASE("A floor is one contact, a right angle two, and in between the second one grows with the angle") {
  const auto groove = [](double slope) {
    return faces(6, [slope](int i, int) { return slope * std::abs(i - 3); });
  };
  const double radius = 1;
  CHECK(touches_of(groove(0), {3.2, 3.4, 0.95}, radius).size() == 1);
  double last = 0;
  for (const double degrees : {0.5, 2.0, 8.0, 20.0, 45.0}) {
    const double angle = degrees * std::acos(-1.0) / 180;
    // In the middle of the groove, 0.05 from both faces; the edge is 0.95/cos from the centre.
    const auto touches = touches_of(groove(std::tan(angle)), {3, 3.4, 0.95 / std::cos(angle)}, radius);
    INFO(degrees);
    REQUIRE(touches.size() == 2);
    CHECK(touches[0].reach - touches[0].distance == Approx(0.05));
    const double second = touches[1].reach - touches[1].distance;
    CHECK(second == Approx(std::min(0.05, 0.95 / std::cos(angle) - 0.95)));
    CHECK(second > last - 1e-12);
    last = second;
    CHECK((touches[1].saddle.feature < 0) == (second > 0.0499));
  }
}

TEST_CASE("Wires that are not connected all count, whichever is nearer") {
  mesh::Surface surface;
  const int count = 61;
  for (int k = 0; k < count; ++k) {
    const double y = 0.01 * (k - count / 2);
    surface.positions.insert(surface.positions.end(), {-1, y, 0, 1, y, 0});
    surface.segments.push_back({2 * k, 2 * k + 1});
  }
  surface.parts = {{.name = "row", .segment_end = count}};
  const Boundary boundary(surface, std::vector<Index>{0});
  const double radius = 0.5, depth = 2.176e-3, height = radius - depth;
  const auto touches = touches_of(boundary, {0, 0, height}, radius);
  double expected = 0;
  std::size_t within = 0;
  for (int k = 0; k < count; ++k) {
    const double distance = std::hypot(height, 0.01 * (k - count / 2));
    if (distance >= radius) continue;
    ++within;
    expected += (radius - distance) * height / distance;
  }
  CHECK(touches.size() == within);
  CHECK(force(boundary, {0, 0, height}, radius).z == Approx(expected).epsilon(1e-12));
  CHECK(touches_of(boundary, {0, 0, height}, radius, ContactRule::tangent_plane).size() == 1);
}

}  // namespace talus::dem
