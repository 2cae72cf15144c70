#include "fem_solver/integration/slide_elimination.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/implicit_solver.hpp"
#include "fem_solver/integration/static_solver.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/structures.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::tests;

const AxialPart rope_part{.section = {.area = 1e-4, .youngs_modulus = 1e10, .prestress = 1e7},
                          .density = 7850};
const AxialPart thread{.section = {.area = 1e-6, .youngs_modulus = 1e9}, .density = 1000};

/// Rope nodes in turn, then the slider, then what the thread is tied to; the thread starts without force.
struct RopeAndSlider {
  std::vector<Vector3> rope;
  Vector3 slider, anchor;
  bool rigid = false;  ///< every node of the rope is held, not only its ends, and nothing pulls in it
};

Model model_of(const RopeAndSlider& scene) {
  Model model;
  const auto add = [&](const Vector3& x) {
    model.reference.insert(model.reference.end(), x.begin(), x.end());
  };
  for (const Vector3& x : scene.rope) add(x);
  add(scene.slider);
  add(scene.anchor);
  const auto count = static_cast<Index>(scene.rope.size());
  std::vector<std::array<Index, 2>> segments;
  std::vector<Index> nodes{0}, held{0, count - 1, count + 1};
  for (Index k = 0; k + 1 < count; ++k) {
    segments.push_back({k, k + 1});
    nodes.push_back(k + 1);
    if (scene.rigid && k > 0) held.push_back(k);
  }
  AxialPart part = rope_part;
  if (scene.rigid) part.section.prestress = 0;
  tests::add_part<CableBatch>(model, "rope", part, std::move(segments));
  tests::add_part<BarBatch>(model, "thread", thread, {{count, count + 1}});
  model.supports.push_back(tests::fixed(held));
  model.constrained_slides.push_back({"edge", {nodes, {count}}});
  return model;
}

struct StaticRun {
  explicit StaticRun(Model built, const StaticOptions& options = {})
      : model(std::move(built)), assembly(model), solver(model, assembly, options) {
    solver.advance(0, options.end);
  }
  Vector3 place(Index node) const {
    return model.position(node) + Vector3::Map(&solver.displacement()[3 * static_cast<std::size_t>(node)]);
  }
  Vector3 reaction(std::size_t supported) const { return Vector3::Map(&solver.reactions()[3 * supported]); }
  Model model;
  Assembly assembly;
  StaticSolver solver;
};

}  // namespace

TEST_CASE(
    "a loaded slider on a rigid wire rests where its forces have no part along it, and both ends share "
    "them") {
  const Vector3 A(0.2, 0.1, 0), B(2, 0.7, -0.9), along = (B - A).normalized();
  const Vector3 start = A + 0.7 * (B - A), anchor(0.9, 1.4, 0.8), push(30, -20, 50);
  Model model = model_of({.rope = {A, B}, .slider = start, .anchor = anchor, .rigid = true});
  model.loads = {tests::load(2, push)};
  const StaticRun run(std::move(model));
  const Vector3 slider = run.place(2);
  CHECK((slider - A).cross(along).norm() < 1e-12);
  const Vector3 pull = run.reaction(2);  // of the anchor on the thread, which is the thread's on the slider
  CHECK(std::abs((pull + push).dot(along)) < 1e-8 * push.norm());
  const Vector3 on_wire = push + pull;
  const double share = (slider - A).norm() / (B - A).norm();
  CHECK(share > 0.05);
  CHECK((run.reaction(0) + (1 - share) * on_wire).norm() < 1e-8 * push.norm());
  CHECK((run.reaction(1) + share * on_wire).norm() < 1e-8 * push.norm());
}

TEST_CASE(
    "a weight on a polygon rests in the corner below it, which carries it, and goes no further than the "
    "rope's end") {
  const std::vector<Vector3> polygon{{0, 0, 1}, {1, 0, 0}, {2, 0, 0.1}, {3, 0, 1}};
  const Vector3 anchor(0.1, 0, 200), weight(0, 0, -100);  // a thread of 5 N/m
  Model model = model_of({.rope = polygon, .slider = {0.1, 0, 0.9}, .anchor = anchor, .rigid = true});
  SECTION("from the left it comes to the lowest node") {
    model.loads = {tests::load(4, weight)};
    const StaticRun run(std::move(model));
    CHECK((run.place(4) - polygon[1]).norm() < 1e-12);
    const Vector3 on_rope = weight + run.reaction(2);  // of the anchor
    CHECK((run.reaction(3) + on_rope).norm() < 1e-9 * weight.norm());
  }
  SECTION("a pull along the whole rope ends at its last node") {
    model.loads = {tests::load(4, {1000, 0, 0})};
    const StaticRun run(std::move(model));
    CHECK((run.place(4) - polygon[3]).norm() < 1e-12);
  }
}

TEST_CASE("Newton converges quadratically where a slider bends a rope that gives way") {
  std::vector<Vector3> rope;
  for (int k = 0; k <= 6; ++k) rope.emplace_back(0.5 * k, 0.02 * k, 0);
  Model model =
      model_of({.rope = rope, .slider = rope[2] + 0.4 * (rope[3] - rope[2]), .anchor = {1.3, -0.3, 1}});
  model.loads = {tests::load(7, {3, 5, -20})};
  const StaticRun run(std::move(model), {.newton = {.tolerance = 1e-13, .most_iterations = 60}});
  const auto& residuals = run.solver.reports().back().residuals;
  WARN("relative residuals: " << tests::listed(residuals));
  CHECK(tests::converges_quadratically(residuals));
  CHECK(run.place(7).z() < -1e-3);  // it did bend
  CHECK(run.solver.slide_gap(0) < 1e-12);
}

TEST_CASE("a bead falls along an inclined wire with the part of gravity along it") {
  const Vector3 A(0, 0, 2), B(2, 1, 0), along = (B - A).normalized(), start = A + 0.1 * (B - A);
  // The thread is 1e5 times too soft to be felt: 0.4 N/m.
  Model model = model_of({.rope = {A, B}, .slider = start, .anchor = {0, 0, 400}, .rigid = true});
  model.node_masses[2] = 5000;
  const Vector3 gravity(0, 0, -9.81);
  weigh(model, gravity);
  Assembly assembly(model);
  ImplicitSolver solver(model, assembly, {.step = 0.02, .spectral_radius = 0.8});
  for (int k = 0; k < 25; ++k) solver.advance(0.02 * k, 0.02);
  const double time = 0.5, path = 0.5 * gravity.dot(along) * time * time;
  const Vector3 moved = Vector3::Map(&solver.displacement()[6]);
  CHECK((moved - path * along).norm() < 1e-4 * path);
}

TEST_CASE("sliders move alike by constraints on velocities and by eliminated directions") {
  std::vector<Vector3> rope;
  for (int k = 0; k <= 4; ++k) rope.emplace_back(0.5 * k, 0, 0);
  const auto model = [&] {
    Model built = model_of({.rope = rope, .slider = {0.62, 0, 0}, .anchor = {0.9, 0.2, -1}});
    built.loads = {tests::load(5, {4, 0, -15})};
    built.node_masses[5] = 0.5;
    return built;
  };
  constexpr double end = 0.02;
  const Model first = model(), second = model();
  Assembly explicit_assembly(first), implicit_assembly(second);
  ExplicitSolver moved(first, explicit_assembly, 2e-6);
  ImplicitSolver solved(second, implicit_assembly, {.step = 2e-5, .spectral_radius = 0.8});
  moved.advance(0, end);
  solved.advance(0, end);
  const Vector3 by_impulses = Vector3::Map(&moved.displacement()[15]);
  const Vector3 by_elimination = Vector3::Map(&solved.displacement()[15]);
  CHECK(by_impulses.norm() > 2e-3);
  CHECK((by_impulses - by_elimination).norm() < 0.01 * by_impulses.norm());
}

TEST_CASE("a slider that cannot follow is named before anything is solved") {
  const std::vector<Vector3> rope{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  Model model = model_of({.rope = rope, .slider = {0.5, 0, 0}, .anchor = {0.5, 0, 1}});
  const auto complaint = [&] {
    try {
      SlideElimination(model, Equations(model));
    } catch (const talus::core::ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  CHECK(complaint() == "no complaint");
  SECTION("supported") {
    model.supports.push_back(tests::fixed({3}, {false, true, false}));
    CHECK_THAT(complaint(),
               Catch::Contains("structure.slides.edge: node 3 of thread at (0.5, 0, 0) m is supported"));
  }
  SECTION("on two ropes") {
    model.constrained_slides.push_back(model.constrained_slides.front());
    CHECK_THAT(complaint(), Catch::Contains("runs on another rope too"));
  }
  SECTION("on ropes that run on each other") {
    const SlideLine& edge = model.constrained_slides.front().line;
    model.constrained_slides.push_back({"back", {{edge.sliders.front(), 4}, {edge.rope[1]}}});
    CHECK_THAT(complaint(), Catch::Contains("in a circle"));
  }
}
