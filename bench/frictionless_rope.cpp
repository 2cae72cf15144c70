// Forces of ropes without friction, by a program that knows friction (`with`) or does not (`without`): what
// a feature costs that a scene does not name. The instructions of both are counted by frictionless_rope.sh;
// the sum printed at the end has the same bits.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <variant>
#include <vector>

#include "fem_solver/model/frictional_cable_batch.hpp"
#include "fem_solver/model/rope_batch.hpp"

namespace {

using namespace talus::fem;

constexpr Index segments = 20;
constexpr int ropes = 50, steps = 200;
constexpr std::size_t values = 3 * (segments + 1);

/// As the assembly does it: one visit a batch.
template <class Element>
double sum_of_forces() {
  std::vector<double> reference;
  std::vector<std::array<Index, 2>> cells;
  for (Index i = 0; i <= segments; ++i) reference.insert(reference.end(), {0.1 * i, 0.02 * (i % 3), 0.0});
  for (Index i = 0; i < segments; ++i) cells.push_back({i, i + 1});
  const AxialPart wire{{.area = 1e-4, .youngs_modulus = 1e11, .prestress = 1e8}, 7850};
  const std::vector<Element> parts(ropes, Element(SlidingCableBatch(wire, 0, cells, reference)));
  std::vector<double> displacement(values), slots(3 * segments);
  double sum = 0;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < values; ++i) displacement[i] = 0.01 * std::sin(double(i) + 0.1 * step);
    for (const Element& part : parts) {
      std::visit(
          [&](const auto& batch) {
            if constexpr (Remembers<std::decay_t<decltype(batch)>>)
              batch.internal_force(displacement, {}, slots, {0, batch.size()});
            else
              batch.internal_force(displacement, slots, {0, batch.size()});
          },
          part);
      sum += slots[3];
    }
  }
  return sum;
}

}  // namespace

int main(int count, char** arguments) {
  const bool with = count > 1 && std::strcmp(arguments[1], "with") == 0;
  fmt::print("{:a}\n", with ? sum_of_forces<std::variant<SlidingCableBatch, FrictionalCableBatch>>()
                            : sum_of_forces<std::variant<SlidingCableBatch>>());
}
