// Explicit steps of a square cable net of about 100 000 elements: elements a second on one and two threads,
// best of several runs, with the machine's copy bandwidth on the same threads beside it. One JSON object a
// line.
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

void measure(int threads) {
  const Model model = cable_net(224);
  talus::core::set_thread_count(threads);
  Assembly assembly(model);
  const double step = 0.5 * 0.1 * std::sqrt(7850 / 1e11);
  ExplicitSolver solver(model, assembly, step);
  constexpr int steps = 200;
  double time = 0;
  const double seconds = best_seconds([&] {
    for (int k = 0; k < steps; ++k, time += step) solver.step(time, step);
  });
  const Index elements = std::get<CableBatch>(model.parts[0].elements).size();
  fmt::print(
      R"({{"element":"cable","elements":{},"threads":{},"elements_per_s":{:.4g},"copy_gb_per_s":{:.3g}}})"
      "\n",
      elements, threads, steps * static_cast<double>(elements) / seconds, copy_gb_per_s());
}

}  // namespace

int main() {
  measure(1);
  measure(2);
}
