// Explicit steps of about 100 000 elements: a square cable net, a membrane with the exact tension field of an
// orthotropic sheet, and sliding ropes. Elements a second on one and two threads, best of several runs, with
// the machine's copy bandwidth on the same threads beside it. One JSON object a line.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/step_limit.hpp"

namespace {

using namespace talus::fem;

/// A net of n x n nodes, pitch 0.1 m, steel wires, prestressed, its corners loaded sideways so that every
/// element moves.
Model cable_net(Index n) {
  Model model;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) model.reference.insert(model.reference.end(), {0.1 * i, 0.1 * j, 0.0});
  std::vector<std::array<Index, 2>> segments;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (i + 1 < n) segments.push_back({j * n + i, j * n + i + 1});
      if (j + 1 < n) segments.push_back({j * n + i, j * n + i + n});
    }
  }
  const AxialPart wire{.section = {.area = 1e-5, .youngs_modulus = 1e11, .prestress = 1e8}, .density = 7850};
  model.parts.push_back(
      {.name = "net", .elements = CableBatch(wire, segments, model.reference), .nodes = {}});
  model.loads.push_back({.name = "pull", .nodes = {n * n / 2}, .force = Vector3(0, 0, 100), .history = {}});
  lump_masses(model);
  return model;
}

/// A sheet of n x n nodes with the moduli and mass of a wire net, held at its rim.
Model wrinkling_sheet(Index n) {
  Model model;
  Support rim{.name = "rim", .nodes = {}, .fixed = {true, true, true}, .history = {}};
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      model.reference.insert(model.reference.end(), {0.1 * i, 0.1 * j, 0.0});
      const Index node = j * n + i;
      if (i == 0 || j == 0 || i == n - 1 || j == n - 1) rim.nodes.push_back(node);
      if (i + 1 == n || j + 1 == n) continue;
      triangles.push_back({node, node + 1, node + n + 1});
      triangles.push_back({node, node + n + 1, node + n});
    }
  const auto moduli = PlaneElasticity::from(OrthotropicSheet{7e9, 5e9, 0.1, 7e7});
  model.parts.push_back({.name = "sheet",
                         .elements = TensionFieldBatch({1e-3, 1000, Vector3(1, 0.3, 0)},
                                                       TensionField<ExactWrinkles>(moduli, {0, 0, 0}),
                                                       triangles, model.reference),
                         .nodes = {}});
  model.supports.push_back(std::move(rim));
  lump_masses(model);
  return model;
}

/// Ropes of 100 segments, each over its own pulleys.
Model ropes(Index count) {
  Model model;
  const AxialPart wire{.section = {.area = 1e-4, .youngs_modulus = 1e11, .prestress = 1e8}, .density = 7850};
  for (Index k = 0; k < count; ++k)
    for (Index i = 0; i <= 100; ++i)
      model.reference.insert(model.reference.end(), {0.1 * i, 0.5 * k, 0.02 * (i % 2)});
  for (Index k = 0; k < count; ++k) {
    std::vector<std::array<Index, 2>> segments;
    for (Index i = 0; i < 100; ++i) segments.push_back({101 * k + i, 101 * k + i + 1});
    model.parts.push_back(
        {.name = "rope", .elements = SlidingCableBatch(wire, 0, segments, model.reference), .nodes = {}});
  }
  lump_masses(model);
  return model;
}

/// Waves of 10 m/s in all directions, so that every element moves and sheets are taut here and wrinkled
/// there.
void shake(const Model& model, ExplicitState& state) {
  for (Index node = 0; node < model.nodes(); ++node) {
    const Vector3 x = model.position(node);
    Vector3::Map(&state.velocity[3 * static_cast<std::size_t>(node)]) =
        10 * Vector3(std::sin(2 * x.x() + x.y()), std::sin(3 * x.y() - x.x()), std::sin(x.x() + x.y()));
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Work>
double best_seconds(const Work& work) {
  double best = 1e300;
  for (int repeat = 0; repeat < 7; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, seconds_since(start));
  }
  return best;
}

/// Bytes read and written a second by a copy of arrays far larger than the caches.
double copy_gb_per_s() {
  std::vector<double> from(1 << 23, 1.0), to(from.size());
  const double seconds = best_seconds([&] {
    talus::core::parallel_blocks(static_cast<std::int64_t>(from.size()),
                                 [&](talus::core::Block r, std::int64_t) {
                                   std::copy(&from[r.begin], &from[0] + r.end, &to[r.begin]);
                                 });
  });
  return 2e-9 * sizeof(double) * static_cast<double>(from.size()) / seconds;
}

/// Steps in which every element is computed, of a structure that moves.
void measure(const char* name, const Model& model, double step) {
  Index elements = 0;
  for (const auto& part : model.parts)
    elements +=
        static_cast<Index>(std::visit([](const auto& batch) { return batch.cells().size(); }, part.elements));
  for (const int threads : {1, 2}) {
    talus::core::set_thread_count(threads);
    Assembly assembly(model);
    ExplicitSolver solver(model, assembly, step);
    shake(model, solver.state());
    constexpr int steps = 100;
    double time = 0;
    const double seconds = best_seconds([&] {
      for (int k = 0; k < steps; ++k, time += step) solver.step(time, step);
    });
    fmt::print(
        R"({{"element":"{}","elements":{},"threads":{},"elements_per_s":{:.4g},"copy_gb_per_s":{:.3g}}})"
        "\n",
        name, elements, threads, steps * static_cast<double>(elements) / seconds, copy_gb_per_s());
  }
}

}  // namespace

int main() {
  measure("cable", cable_net(224), 0.5 * 0.1 * std::sqrt(7850 / 1e11));
  measure("membrane with tension field", wrinkling_sheet(224), 0.2 * 0.1 * std::sqrt(1000 / 7e9));
  measure("segment of a sliding cable", ropes(1000), 0.2 * 0.1 * std::sqrt(7850 / 1e11));
}
