#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem_solver/solver.hpp"

/// The bed of spheres that the codes are compared on: equal spheres on a jittered lattice above the floor of
/// an open box, thrown down with random velocities so that contacts form early. Glass-like stiffness scaled
/// down, as such comparisons do.
namespace talus::bench {

struct Bed {
  static constexpr double radius = 0.01;         ///< m
  static constexpr double density = 2500;        ///< kg/m^3
  static constexpr double youngs_modulus = 1e7;  ///< Pa
  static constexpr double poissons_ratio = 0.2;
  static constexpr double restitution = 0.3;
  static constexpr double friction = 0.5;
  static constexpr double step = 1e-5;  ///< s

  double side = 0;  ///< m; of the square box
  double top = 0;   ///< m; above all spheres
  std::vector<dem::SphereInput> spheres;
};

/// The same bed on every machine.
Bed make_bed(std::int64_t count);

dem::ParticleModel model_of(const Bed& bed, int threads);

/// Writes the bed for LIGGGHTS and LAMMPS (`read_data`).
void write_data_file(const Bed& bed, const std::string& path);

}  // namespace talus::bench
