#pragma once

#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// Orientation as a unit quaternion: turns body axes into space, w the real part.
using Quaternion = Quad<double>;

Triple<double> rotate(const Quaternion& q, const Triple<double>& in_body) noexcept;
Triple<double> rotate_back(const Quaternion& q, const Triple<double>& in_space) noexcept;
Quaternion product(const Quaternion& a, const Quaternion& b) noexcept;

/// rad/s, in space: the angular velocity of a body with principal moments I (kg m^2) and angular momentum L
/// (kg m^2/s, in space).
Triple<double> angular_velocity(const Quaternion& q, const Triple<double>& momentum,
                                const Triple<double>& moments) noexcept;

struct FreeTurn {
  Triple<double> momentum;  ///< kg m^2/s; in space, kept exactly
  Triple<double> moments;   ///< kg m^2; principal
  double step = 0;          ///< s
};

/// Turns a free body for one step: exact rotations about its principal axes one after the other, x/2 y/2 z
/// y/2 x/2 [Dullweber, Leimkuhler, McLachlan, J. Chem. Phys. 107 (1997) 5840]. Second order, symplectic and
/// reversible; the momentum in space does not enter the change, so it is kept to the bit, and the energy
/// error stays bounded. Test: "A free asymmetric top keeps its energy over a million steps and
/// turns with its closed form's period".
Quaternion turned(const Quaternion& q, const FreeTurn& turn) noexcept;

}  // namespace talus::dem
