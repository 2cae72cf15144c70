#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "coupler/run/schedule.hpp"
#include "coupler/scene/coupled_scene.hpp"
#include "coupler/work_meter.hpp"

using namespace talus;
using namespace talus::coupler;

TEST_CASE("output falls on the windows nearest to the multiples of its interval") {
  const Span span{.end = 1e-2, .window_length = 3e-4};
  constexpr double every = 1e-3;
  Schedule schedule(span, every);
  std::vector<std::int64_t> due;
  for (std::int64_t n = 0; n < span.windows(); ++n) {
    if (!schedule.due(n)) continue;
    due.push_back(n);
    schedule.done(n);
  }
  std::vector<std::int64_t> expected;
  const auto nearest = [&](int k) { return std::llround(k * every / span.window_length); };
  for (int k = 0; nearest(k) < span.windows(); ++k) expected.push_back(nearest(k));
  CHECK(due == expected);
  CHECK(static_cast<std::int64_t>(due.size()) <= schedule.count(span.windows()));
}

TEST_CASE("a million windows are a million windows, not one more by round-off") {
  CHECK(Span{.end = 50.0, .window_length = 50e-6}.windows() == 1000000);
  CHECK(Span{.end = 0.2, .window_length = 50e-6}.windows() == 4000);
  CHECK(Span{.end = 1.01e-3, .window_length = 1e-3}.windows() == 2);
}

TEST_CASE("work is force times path, window by window") {
  const std::vector<double> force{0, 2, -1}, start{5, 1, 1}, end{7, 4, 3}, still{0, 0, 0};
  constexpr double expected = 2 * (4 - 1) + -1 * (3 - 1);
  constexpr WorkMeter::Window window{ForceMeaning::mean, 0.1};
  CHECK(WorkMeter(window, force, {start, still}).end(force, end) == expected);
  CHECK(WorkMeter(window, force, {end, still}).end(force, end) == 0);  // nothing moved
  CHECK(work_on_path(force, start, end) == expected);
}

TEST_CASE("the work of many nodes is the sum of force times path, loaded or not, in any place") {
  // 67 values: two blocks of those that are looked at together and a rest; the first block bears nothing.
  std::vector<double> force(67, 0.0), start(67), end(67);
  double expected = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (i >= 24 && i % 5 != 0) force[i] = 1.0 + static_cast<double>(i);
    start[i] = static_cast<double>(i % 7);
    end[i] = start[i] + 0.25 * static_cast<double>(i % 3);
    expected += force[i] * (end[i] - start[i]);
  }
  const WorkMeter meter({ForceMeaning::mean, 0.1}, force, {start, start});
  CHECK(meter.end(force, end) == Approx(expected).epsilon(1e-14));
  CHECK(work_on_path(force, start, end) == Approx(expected).epsilon(1e-14));
}

TEST_CASE("the work of forces at a window's start is what the leapfrog's kinetic energy gains") {
  constexpr double mass = 2, step = 0.01;
  std::vector<double> position{0}, velocity{1}, force{0};
  const double first_velocity = velocity[0];
  double work = 0;
  for (int n = 0; n < 100; ++n) {
    force[0] = 30 * std::sin(0.1 * n) - 4 * position[0];
    const WorkMeter meter({ForceMeaning::at_start, step}, force, {position, velocity});
    velocity[0] += step * force[0] / mass;
    position[0] += step * velocity[0];
    work += meter.end(force, position);
  }
  // f = m (v+ - v-)/L, so f . (v+ + v-) L/2 = m (v+^2 - v-^2)/2, which telescopes.
  const double gained = 0.5 * mass * (velocity[0] * velocity[0] - first_velocity * first_velocity);
  CHECK(work == Approx(gained).epsilon(1e-12));
}

namespace {

std::vector<std::string> complaints_about(const std::string& yaml) {
  std::vector<core::Complaint> complaints;
  read_coupled_scene(core::SceneFile::parse(yaml, "s.yaml"), complaints);
  std::vector<std::string> texts;
  for (const auto& complaint : complaints) texts.push_back(complaint.text());
  return texts;
}

const std::string sides = "time: {end: 1 s, step: 1 ms}\nstructure: {anything: 1}\nparticles: {at: all}\n";

}  // namespace

TEST_CASE("the coupler reads its own sections and leaves the solvers theirs") {
  CHECK(complaints_about(sides).empty());
  CHECK(complaints_about(
            sides + "interface: {structure: [net], boundary: {same_as_structure: {wire_radius: 4 mm}}}\n")
            .empty());
}

TEST_CASE("scenes the coupler cannot run are refused with the reason") {
  using Texts = std::vector<std::string>;
  CHECK(complaints_about("time: {end: 1 s, step: 1 ms}\n") ==
        Texts{"s.yaml: has neither a section 'structure' nor a section 'particles'"});
  CHECK(complaints_about("time: {end: 1 s, step: 1 ms}\nstructure: {}\n"
                         "interface: {structure: [net], boundary: {same_as_structure: {}}}\n") ==
        Texts{"s.yaml: interface: needs both a structure and particles, but the scene has only one of them"});
  CHECK(complaints_about("time: {end: 1 s}\nstructure: {}\nparticles: {}\n") ==
        Texts{"s.yaml: time.step: is missing, and so is 'coupling.window'"});
  CHECK(complaints_about(sides + "coupling: {timeout: -1 s}\n").size() == 1);
  CHECK(complaints_about(sides + "coupling: {join_timeout: 0 s, window: 0 s}\n").size() == 2);
  CHECK(complaints_about(sides + "interface: {structure: [], boundary: {same_as_structure: {}}}\n") ==
        Texts{"s.yaml:4:24: interface.structure: must name at least one part"});
  CHECK(complaints_about(
            sides + "interface: {structure: [net], boundary: {same_as_structure: {wire_radius: -1 mm}}}\n")
            .size() == 1);
}

TEST_CASE("strong schemes are read with their accelerations, and wrong ones are refused") {
  const auto with = [](const std::string& scheme) {
    return complaints_about(sides + "coupling: {" + scheme + "}\n");
  };
  CHECK(with("serial_implicit: {}").empty());
  CHECK(with("serial_implicit: {relax: force, predictor: constant, aitken: {initial: 0.3}}").empty());
  CHECK(with("parallel_implicit: {iqn_ils: {columns: 20, windows: 3}, tolerance: {relative: 1e-4}, "
             "not_converged: warning}")
            .empty());
  CHECK(with("parallel_explicit: {}").empty());
  CHECK(with("serial_implicit: {aitken: {}, iqn_ils: {}}").size() == 1);
  CHECK(with("serial_implicit: {fixed: {factor: 0}}").size() == 1);
  CHECK(with("serial_implicit: {relax: speed}").size() == 1);
  CHECK(with("serial_implicit: {iterations: 0}").size() == 1);
  CHECK(with("serial_implicit: {iqn_ils: {filter: 1e-9}}").size() == 1);
  CHECK(with("serial_explicit: {}, serial_implicit: {}").size() == 1);
}

TEST_CASE("windows that grow and windows that are halved are read, and lengths that do nothing are refused") {
  const auto with = [](const std::string& coupling, bool interface = true) {
    return complaints_about(
        sides + "coupling: {" + coupling + "}\n" +
        (interface ? "interface: {structure: [net], boundary: {same_as_structure: {}}}\n" : ""));
  };
  using Texts = std::vector<std::string>;
  CHECK(with("longest_window: 2 ms").empty());
  CHECK(with("longest_window: 1.9 ms") ==
        Texts{"s.yaml: coupling.longest_window: must be at least two windows of 1 ms"});
  CHECK(with("longest_window: 2 ms", false) ==
        Texts{"s.yaml: coupling.longest_window: needs an interface, without which nothing can touch"});
  CHECK(with("longest_window: 0 s").size() == 1);
  CHECK(with("serial_implicit: {shortest_window: 0.5 ms}").empty());
  CHECK(with("serial_implicit: {shortest_window: 0.51 ms}") ==
        Texts{"s.yaml: coupling.serial_implicit.shortest_window: must be at most half a window of 1 ms"});
  CHECK(with("parallel_implicit: {shortest_window: 1 ms}") ==
        Texts{"s.yaml: coupling.parallel_implicit.shortest_window: must be at most half a window of 1 ms"});
  CHECK(with("serial_explicit: {shortest_window: 0.1 ms}").size() == 1);
}

TEST_CASE("the shortest and the longest window are counted in regular ones") {
  CoupledScene scene;
  scene.time.end = 0.3;
  scene.coupling.window = 0.3e-3;
  CHECK(scene.longest_window() == 1);
  CHECK(scene.most_halvings() == 0);
  scene.coupling.longest_window = 3e-3;  // 9.999... in binary
  CHECK(scene.longest_window() == 10);
  SerialImplicitScene implicit;
  implicit.common.shortest_window = 0.3e-3 / 8;
  scene.coupling.scheme = implicit;
  CHECK(scene.most_halvings() == 3);
  implicit.common.shortest_window = 0.3e-3 / 9;
  scene.coupling.scheme = implicit;
  CHECK(scene.most_halvings() == 3);
}
