// Cost of one pass of an acceleration at a full set of columns: what a strong scheme pays an iteration beside
// the solvers. The unknown is one interface field, three values a node. One JSON object a line; medians over
// passes.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <vector>

#include "coupler/acceleration/iqn_ils.hpp"
#include "coupler/acceleration/relaxation.hpp"

using namespace talus::coupler;

namespace {

constexpr int passes = 25;

template <class Acceleration>
void measure(const char* kind, int nodes, std::size_t columns, Acceleration acceleration) {
  std::mt19937 generator(1);
  std::normal_distribution<double> value;
  std::vector<double> x(3 * static_cast<std::size_t>(nodes)), made(x.size()), milliseconds;
  acceleration.begin_window();
  for (std::size_t pass = 0; pass < columns + 1 + passes; ++pass) {
    for (double& component : made) component = value(generator);
    const auto begin = std::chrono::steady_clock::now();
    acceleration.update(x, made);
    if (pass > columns) {
      milliseconds.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  fmt::print("{{\"kind\":\"{}\",\"nodes\":{},\"columns\":{},\"ms_per_pass\":{:.3f}}}\n", kind, nodes, columns,
             milliseconds[milliseconds.size() / 2]);
}

}  // namespace

int main() {
  for (const int nodes : {1000, 10000, 100000}) {
    measure("fixed", nodes, 0, FixedRelaxation{});
    measure("aitken", nodes, 0, Aitken(0.5));
    for (const std::size_t columns : {10UL, 50UL})
      measure("iqn_ils", nodes, columns, IqnIls({.most_columns = columns}));
  }
}
