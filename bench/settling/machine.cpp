#include "bench/settling/machine.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

#include "core/parallel.hpp"

namespace talus::bench {

namespace {

constexpr int repetitions = 5;
constexpr std::size_t copied_bytes = std::size_t{64} << 20;  // a thread; beyond the last cache
constexpr int multiplications = 20'000'000;  // of each of four chains, a few hundredths of a second

/// s; the fastest of several repetitions of one task a thread: what others on the machine add is never
/// negative.
template <class Work>
double fastest_seconds(int threads, const Work& work) {
  double fastest = 1e30;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    core::parallel_tasks({threads, threads}, work);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    fastest = std::min(fastest, wall.count());
  }
  return fastest;
}

/// Chains of multiplications that depend on each other, so that neither memory nor the compiler shortens
/// them.
double multiply() {
  double a = 1, b = 2, c = 3, d = 4;
  for (int k = 0; k < multiplications; ++k) {
    a *= 1.0000001;
    b *= 0.9999999;
    c *= 1.0000001;
    d *= 0.9999999;
  }
  return a + b + c + d;
}

}  // namespace

MachineSpeedup measure_machine(int threads) {
  std::vector<double> products(static_cast<std::size_t>(threads));
  const auto arithmetic = [&](std::int64_t task) { products[static_cast<std::size_t>(task)] = multiply(); };
  std::vector<std::vector<char>> from(static_cast<std::size_t>(threads)), to = from;
  for (auto* side : {&from, &to})
    for (auto& bytes : *side) bytes.assign(copied_bytes / 2, 1);
  const auto copy = [&](std::int64_t task) {
    const auto k = static_cast<std::size_t>(task);
    std::memcpy(to[k].data(), from[k].data(), from[k].size());
  };
  const double one_copy = fastest_seconds(1, copy);
  return {.arithmetic = threads * fastest_seconds(1, arithmetic) / fastest_seconds(threads, arithmetic),
          .copy = threads * one_copy / fastest_seconds(threads, copy),
          .copy_gb_per_s = 1e-9 * static_cast<double>(copied_bytes) / one_copy};
}

}  // namespace talus::bench
