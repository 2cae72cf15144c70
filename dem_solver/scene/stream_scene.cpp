#include "dem_solver/scene/stream_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "core/scene/plausible.hpp"

namespace talus::dem {

namespace {

/// Cells of the box that each take one sphere.
struct Cells {
  std::array<std::int64_t, 3> count{};
  core::Vector3 size = core::Vector3::Zero();  ///< m

  explicit Cells(const StreamScene& stream) {
    const double diameter = 2 * stream.radius.back();
    for (int k = 0; k < 3; ++k) {
      const double extent = stream.high[k] - stream.low[k];
      constexpr double most = 2e6;  // so that their product is a number of 64 bits
      count[k] = static_cast<std::int64_t>(std::min(most, std::floor(extent / diameter * (1 + 1e-12))));
      size[k] = count[k] > 0 ? extent / static_cast<double>(count[k]) : 0;
    }
  }
  std::int64_t total() const { return count[0] * count[1] * count[2]; }
};

/// Uniform in [0, 1), the same numbers in every standard library.
class Uniform {
 public:
  explicit Uniform(std::int64_t seed) : engine_(static_cast<std::uint64_t>(seed)) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// Selection sampling (Knuth, algorithm S): every choice of cells is equally likely, without a list of them; visit(cell)
/// in ascending order.
template <class Visit>
void walk(std::int64_t cells, std::int64_t wanted, Uniform& random, const Visit& visit) {
  for (std::int64_t c = 0; c < cells && wanted > 0; ++c) {
    if (random() * static_cast<double>(cells - c) >= static_cast<double>(wanted)) continue;
    --wanted;
    visit(c);
  }
}

/// The same for few of very many cells (Floyd's algorithm: J. Bentley, Programming Pearls, 1987): the cost is that of
/// those wanted.
template <class Visit>
void pick(std::int64_t cells, std::int64_t wanted, Uniform& random, const Visit& visit) {
  std::set<std::int64_t> chosen;
  for (std::int64_t last = cells - wanted; last < cells; ++last) {
    const auto c = static_cast<std::int64_t>(random() * static_cast<double>(last + 1));
    if (!chosen.insert(c).second) chosen.insert(last);
  }
  for (const std::int64_t c : chosen) visit(c);
}

}  // namespace

void describe(core::Fields& fields, StreamScene& stream) {
  fields.required("material", stream.material, {.help = "contact material; its density gives the masses"});
  fields.required("count", stream.count, {.range = {.low = 1, .high = 1e8}, .help = "number of spheres"});
  fields.required("radius", stream.radius,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "[smallest, largest], or [one] for all",
                   .plausible = core::plausible::rock_size});
  fields.required("low", stream.low, {.unit = "m", .help = "lower corner of the box they start in"});
  fields.required("high", stream.high, {.unit = "m", .help = "upper corner"});
  fields.with_default("velocity", stream.velocity,
                      {.unit = "m/s", .help = "of all, at time 0", .plausible = core::plausible::velocity});
  fields.with_default("seed", stream.seed,
                      {.range = core::not_negative, .help = "of the random places and sizes"});
  const bool sizes =
      stream.radius.size() == 1 || (stream.radius.size() == 2 && stream.radius[0] <= stream.radius[1]);
  fields.rule(sizes, "radius", "needs one value, or the smallest and the largest");
  if (!sizes || stream.radius.back() <= 0) return;
  const Cells cells(stream);
  fields.rule(stream.count <= cells.total(), "count",
              "the box has room for " + std::to_string(cells.total()) + " spheres of radius " +
                  std::to_string(stream.radius.back()) + " m side by side, but " +
                  std::to_string(stream.count) + " are asked for");
}

std::vector<SphereInput> make_stream(const StreamScene& stream, double density) {
  const Cells cells(stream);
  Uniform random(stream.seed);
  std::vector<SphereInput> spheres;
  const auto place = [&](std::int64_t c) {
    const double radius =
        stream.radius.front() * std::pow(stream.radius.back() / stream.radius.front(), random());
    const std::array<std::int64_t, 3> cell{c % cells.count[0], c / cells.count[0] % cells.count[1],
                                           c / (cells.count[0] * cells.count[1])};
    core::Vector3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = stream.low[k] + static_cast<double>(cell[k]) * cells.size[k] + radius +
             random() * (cells.size[k] - 2 * radius);
    spheres.push_back({.position = {p.x(), p.y(), p.z()},
                       .velocity = {stream.velocity.x(), stream.velocity.y(), stream.velocity.z()},
                       .spin = {},
                       .radius = radius,
                       .mass = density * 4.0 / 3 * std::numbers::pi * radius * radius * radius});
  };
  constexpr std::int64_t most_walked = 100'000'000;  // half a second
  if (cells.total() <= most_walked)
    walk(cells.total(), stream.count, random, place);
  else
    pick(cells.total(), stream.count, random, place);
  return spheres;
}

}  // namespace talus::dem
