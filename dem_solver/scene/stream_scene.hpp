#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/fields.hpp"
#include "dem_solver/particles/spheres.hpp"

/// `particles.streams` of a scene.
namespace talus::dem {

/// Many single spheres released together from a box.
struct StreamScene {
  std::string material;
  std::int64_t count = 0;
  std::vector<double> radius;                 ///< m; smallest and largest, or one value
  core::Vector3 low = core::Vector3::Zero();  ///< m; corners of the box
  core::Vector3 high = core::Vector3::Zero();
  core::Vector3 velocity = core::Vector3::Zero();  ///< m/s
  std::int64_t seed = 1;
};
void describe(core::Fields& fields, StreamScene& stream);

/// The stream's spheres, at random and apart from each other: each in its own cell of a grid that the largest
/// of them fits into. Radii are uniform in their logarithm between the smallest and the largest. The same on
/// every machine.
/// @pre the scene was read without complaints (which is where a box too small is refused)
std::vector<SphereInput> make_stream(const StreamScene& stream, double density);

}  // namespace talus::dem
