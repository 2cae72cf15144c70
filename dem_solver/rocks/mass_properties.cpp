#include "dem_solver/rocks/mass_properties.hpp"

namespace talus::dem {

MassProperties mass_properties(const VolumeMoments& moments, double density) {
  const core::Vector3 centre = moments.first / moments.volume;
  const Matrix3 central = moments.second - moments.volume * centre * centre.transpose();
  const Matrix3 inertia = density * (central.trace() * Matrix3::Identity() - central);
  return {density * moments.volume, centre, inertia};
}

}  // namespace talus::dem
