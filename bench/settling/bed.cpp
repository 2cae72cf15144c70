#include "bench/settling/bed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

namespace talus::bench {

namespace {

constexpr double lattice = 0.0215;   // m; the jitter of neighbours cannot make them overlap
constexpr double jitter = 0.0005;    // m
constexpr double tower_ratio = 1.7;  // height over side

/// Uniform in [-1, 1), the same numbers in every standard library.
class Uniform {
 public:
  double operator()() { return static_cast<double>(engine_()) / 2147483648.0 - 1; }

 private:
  std::mt19937 engine_{20111};
};

}  // namespace

Bed make_bed(std::int64_t count) {
  const auto across =
      std::max<std::int64_t>(3, std::llround(std::cbrt(static_cast<double>(count) / tower_ratio)));
  Bed bed;
  bed.side = static_cast<double>(across) * lattice + 2 * jitter;
  bed.top = (std::ceil(static_cast<double>(count) / static_cast<double>(across * across)) + 2) * lattice;
  const double mass = Bed::density * 4.0 / 3 * std::numbers::pi * std::pow(Bed::radius, 3);
  Uniform random;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto at = [&](std::int64_t k) {
      return (static_cast<double>(k) + 0.5) * lattice + jitter * random();
    };
    const std::int64_t layer = i / (across * across), place = i % (across * across);
    const double x = jitter + at(place % across), y = jitter + at(place / across), z = at(layer);
    const double vx = 0.5 * random(), vy = 0.5 * random(), vz = -1 + 0.5 * random();
    bed.spheres.push_back(
        {.position = {x, y, z}, .velocity = {vx, vy, vz}, .spin = {}, .radius = Bed::radius, .mass = mass});
  }
  return bed;
}

dem::ParticleModel model_of(const Bed& bed, int threads) {
  using namespace dem;
  const Material material{.name = "glass",
                          .density = Bed::density,
                          .youngs_modulus = Bed::youngs_modulus,
                          .poissons_ratio = Bed::poissons_ratio};
  PairParameters p = pair_parameters(HertzContact{Bed::restitution}, effective_moduli(material, material));
  set_friction(p, {.at_rest = Bed::friction, .sliding = Bed::friction});
  ParticleModel model;
  model.pairs = PairTable(1);
  model.pairs.set(0, 0, p);
  model.law = {.friction = LawChoice::FrictionKind::constant};
  model.spheres = bed.spheres;
  model.planes = {{"floor", {0, 0, 0}, {0, 0, 1}},
                  {"west", {0, 0, 0}, {1, 0, 0}},
                  {"east", {bed.side, 0, 0}, {-1, 0, 0}},
                  {"south", {0, 0, 0}, {0, 1, 0}},
                  {"north", {0, bed.side, 0}, {0, -1, 0}}};
  model.gravity = {0, 0, -9.81};
  model.step = Bed::step;
  model.threads = threads;
  return model;
}

void write_data_file(const Bed& bed, const std::string& path) {
  std::ofstream file(path);
  file << fmt::format(
      "settling bed\n\n{} atoms\n1 atom types\n\n0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n-0.001 {:.17g} zlo "
      "zhi\n\nAtoms\n\n",
      bed.spheres.size(), bed.side, bed.side, bed.top);
  std::size_t id = 0;
  for (const dem::SphereInput& s : bed.spheres)
    file << fmt::format("{} 1 {} {} {:.17g} {:.17g} {:.17g}\n", ++id, 2 * s.radius, Bed::density,
                        s.position.x, s.position.y, s.position.z);
  file << "\nVelocities\n\n";
  id = 0;
  for (const dem::SphereInput& s : bed.spheres)
    file << fmt::format("{} {:.17g} {:.17g} {:.17g} 0 0 0\n", ++id, s.velocity.x, s.velocity.y, s.velocity.z);
}

}  // namespace talus::bench
