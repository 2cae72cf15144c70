#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem_solver/scene/particles_scene.hpp"

namespace talus::dem {

/// Which key of the scene each sphere of a model comes from: "particles.spheres.boulder",
/// "particles.rocks.block", "particles.streams.stones".
class BodyNames {
 public:
  /// @param spheres as build_model() adds them: named ones, those of rocks, streams
  BodyNames(const ParticlesScene& particles, std::span<const SphereInput> spheres);
  const std::string& key(Index sphere) const { return keys_[key_of_[sphere]]; }
  bool in_stream(Index sphere) const { return key_of_[sphere] >= first_stream_; }

 private:
  std::vector<std::string> keys_;
  std::vector<std::size_t> key_of_;
  std::size_t first_stream_ = 0;
};

}  // namespace talus::dem
