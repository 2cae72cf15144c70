#include "dem_solver/scene/stream_scene.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
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
      count[k] = static_cast<std::int64_t>(std::floor(extent / diameter * (1 + 1e-12)));
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
  std::int64_t left = stream.count;
  for (std::int64_t c = 0; c < cells.total() && left > 0; ++c) {
    // Selection sampling (Knuth, algorithm S): every choice of cells is equally likely, without a list of
    // them.
    if (random() * static_cast<double>(cells.total() - c) >= static_cast<double>(left)) continue;
    --left;
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
  }
  return spheres;
}

}  // namespace talus::dem
