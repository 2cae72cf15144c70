#include "dem_solver/app/window_force.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::dem;

namespace {

/// One wire between two nodes, of which the second belongs to the interface.
struct Wire {
  Boundary boundary;
  Wire() {
    mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0}, .segments = {{0, 1}}};
    surface.parts = {{.name = "wire", .segment_end = 1}};
    boundary = Boundary(surface, std::vector<Index>{0});
  }
  /// The node of the interface receives this force.
  const Boundary& loaded(double force) {
    boundary.clear_reactions();
    boundary.react(boundary.features()[0], {0, 1, 0}, {0, 0, -force});
    return boundary;
  }
};

/// A force that changes in time, its velocity, and their integrals.
struct Course {
  double rate = 30;  ///< 1/s
  double force(double t) const { return 100 * std::sin(rate * t); }
  double impulse(double from, double to) const {
    return 100 / rate * (std::cos(rate * from) - std::cos(rate * to));
  }
  double velocity(double t) const { return 2 * t; }
  double work(double from, double to) const {
    const auto primitive = [&](double t) {
      return 200 / (rate * rate) * (std::sin(rate * t) - rate * t * std::cos(rate * t));
    };
    return primitive(to) - primitive(from);
  }
};

/// The means and works of windows of equal length, from time 0 on.
struct Windows {
  std::vector<double> means, works;
  Windows(const Course& course, const WindowForce::Window& window, int count) {
    Wire wire;
    WindowForce force(1, 1);
    std::vector<double> mean(3);
    const double step = window.length / static_cast<double>(window.steps);
    for (int n = 0; n < count; ++n) {
      force.begin(window, mean);
      for (std::int64_t k = 0; k <= window.steps; ++k) {
        if (k == window.steps && !force.needs_end()) break;
        const double t = n * window.length + static_cast<double>(k) * step;
        force.add(wire.loaded(course.force(t)), k, [&](std::size_t) {
          return Triple<double>{0, 0, course.velocity(t)};
        });
      }
      means.push_back(mean[2]);
      works.push_back(force.work());
    }
  }
};

}  // namespace

TEST_CASE(
    "the force of a window of one step that the structure meets with one step is that at its start, bit for "
    "bit") {
  const Windows windows(Course{}, {.length = 0.1, .steps = 1, .shift = 0.05}, 3);
  for (int n = 0; n < 3; ++n) CHECK(windows.means[n] == Course{}.force(n * 0.1));
}

TEST_CASE("the forces of a window are the mean over the structure's own interval") {
  // The midpoint rule of the steps is wrong by (rate h)^2/24 of the force, the parts of steps at the interval's
  // ends by h/2 times the slope times their half length: both below 100 N (30 h)^2 / 4.
  const Course course;
  constexpr double length = 0.01;
  for (const std::int64_t steps : {1, 2, 4, 16, 64})
    for (const int of_structure : {0, 1, 2, 4, 16}) {  // 0: a load over the window
      const double shift = of_structure == 0 ? 0 : 0.5 * length / of_structure;
      const Windows windows(course, {.length = length, .steps = steps, .shift = shift}, 8);
      const double step = length / static_cast<double>(steps),
                   allowed = 100 * std::pow(30 * std::max(step, shift), 2) / 4;
      for (int n = 1; n < 8; ++n) {
        CAPTURE(steps, of_structure, n);
        const double from = n * length - shift;
        CHECK(windows.means[n] == Approx(course.impulse(from, from + length) / length).margin(allowed));
        CHECK(windows.works[n] ==
              Approx(course.work(from, from + length)).margin(allowed * 0.16 * length + 1e-6));
      }
    }
}

TEST_CASE(
    "no impulse is lost or made, whatever the steps of both sides and however windows change their length") {
  Wire wire;
  WindowForce force(1, 1);
  std::vector<double> mean(3);
  double handed = 0, given = 0, first_end = 0;
  const std::vector<WindowForce::Window> windows{{0.1, 4, 0.05}, {0.1, 4, 0.05},   {0.05, 2, 0.025},
                                                 {0.05, 2, 0},   {0.1, 1, 0.0125}, {0.2, 8, 0.1},
                                                 {0.1, 4, 0.05}};
  double value = 1;
  for (const auto& window : windows) {
    const double step = window.length / static_cast<double>(window.steps);
    force.begin(window, mean);
    for (std::int64_t k = 0; k < window.steps; ++k) {
      value = std::fmod(3.7 * value + 1.3, 5.0);
      force.add(wire.loaded(value), k, [](std::size_t) { return Triple<double>{}; });
      given += value * step;
    }
    if (force.needs_end())
      force.add(wire.loaded(first_end = 17), window.steps, [](std::size_t) { return Triple<double>{}; });
    handed += mean[2] * window.length;
  }
  force.begin({0.1, 1, 0.05}, mean);  // nothing touches any more: what is left comes
  handed += mean[2] * 0.1;
  CHECK(handed == Approx(given).epsilon(1e-12));
}
