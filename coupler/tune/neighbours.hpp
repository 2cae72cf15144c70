#pragma once

#include <string>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::core {
class SceneFile;
}

namespace talus::tune {

/// A scene like another one, whose rocks hit it a little otherwise.
struct Neighbour {
  std::string name;  ///< "20 % faster"
  std::vector<study::Setting> settings;
};

/// By how much speed and mass change, and the place by this share of a body's diameter.
inline constexpr double perturbation = 0.2;

/// Spheres and rocks that move at time 0, 20 % faster and slower, heavier and lighter (density of their
/// materials, or the mass of a block that names one), and shifted across their way by 20 % of their diameter.
/// None where nothing moves.
std::vector<Neighbour> neighbours_of(const core::SceneFile& scene);

}  // namespace talus::tune
