#include "dem_solver/scene/body_names.hpp"

namespace talus::dem {

BodyNames::BodyNames(const ParticlesScene& particles, std::span<const SphereInput> spheres) {
  for (const auto& [name, sphere] : particles.spheres) keys_.push_back("particles.spheres." + name);
  const std::size_t first_rock = keys_.size();
  for (const auto& [name, rock] : particles.rocks) keys_.push_back("particles.rocks." + name);
  first_stream_ = keys_.size();
  for (const auto& [name, stream] : particles.streams) keys_.push_back("particles.streams." + name);

  for (std::size_t k = 0; k < first_rock; ++k) key_of_.push_back(k);
  for (std::size_t k = first_rock; k < spheres.size() && spheres[k].rock >= 0; ++k)
    key_of_.push_back(first_rock + static_cast<std::size_t>(spheres[k].rock));
  for (std::size_t k = 0; k < particles.streams.size(); ++k)
    key_of_.insert(key_of_.end(), static_cast<std::size_t>(particles.streams[k].second.count),
                   first_stream_ + k);
}

}  // namespace talus::dem
