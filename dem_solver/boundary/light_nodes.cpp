#include "dem_solver/boundary/light_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace talus::dem {

LightNodes::LightNodes(std::span<const double> masses, Index first)
    : first_(first), displacement_(3 * masses.size()), velocity_(3 * masses.size()) {
  for (const double mass : masses) inverse_mass_.push_back(mass > 0 ? 1 / mass : 0);
}

void LightNodes::begin_window(std::span<const double> impulse) noexcept {
  std::ranges::fill(displacement_, 0.0);
  for (std::size_t i = 0; i < velocity_.size(); ++i) velocity_[i] = inverse_mass_[i / 3] * impulse[i];
}

void LightNodes::displace(Boundary& boundary) const noexcept {
  boundary.displace({displacement_, velocity_, first_});
}

void LightNodes::answer(const Boundary& boundary, double step) noexcept {
  const std::span<const Row> reaction = boundary.reaction().subspan(static_cast<std::size_t>(first_));
  for (std::size_t i = 0; i < inverse_mass_.size(); ++i) {
    const double gain = step * inverse_mass_[i];
    double *w = &velocity_[3 * i], *d = &displacement_[3 * i];
    w[0] += gain * reaction[i].x;
    w[1] += gain * reaction[i].y;
    w[2] += gain * reaction[i].z;
    for (int k = 0; k < 3; ++k) d[k] += step * w[k];
  }
}

}  // namespace talus::dem
