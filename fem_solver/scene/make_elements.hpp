#pragma once

#include <array>
#include <string>
#include <vector>

#include "fem_solver/model/model.hpp"
#include "fem_solver/scene/element_scenes.hpp"

namespace talus::fem {

/// The lines and triangles of a part by the model's node numbers, and where the scene speaks of it.
struct MeshedElements {
  std::string key;  ///< "scene.yaml:12: structure.parts.net"
  std::vector<std::array<Index, 2>> segments;
  std::vector<std::array<Index, 3>> triangles;
};

/// What a scene writes for one wire, of several side by side: area and what it bears are theirs together.
/// An element without area stays as it is.
ElementScene of_wires(const ElementScene& scene, int wires);

/// N; of the key `breaking_load`, or else of `breaks.force`, or of the calibration of rings. 0: not known
double breaking_load_of(const ElementScene& scene);

/// N; pi^2 E I/L^2 (Euler) of the longest bar of a part whose scene gives I, hinged at both ends. 0: not known
double buckling_load_of(const ElementScene& scene, const ElementBatch& elements);

/// @throws core::ConfigError naming the key where the shape does not fit the element, or its geometry cannot
/// be computed with
ElementBatch make_elements(const ElementScene& scene, const MeshedElements& elements, const Model& model);

}  // namespace talus::fem
