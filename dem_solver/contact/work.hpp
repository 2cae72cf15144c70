#pragma once

#include "dem_solver/contact/touch.hpp"

/// What the contacts did with the energy, for scenes that write a ledger.
namespace talus::dem {

/// Work of contact forces since the start of the run, J.
struct ContactWork {
  double damping = 0;   ///< dissipated by the normal dashpot
  double friction = 0;  ///< dissipated tangentially: sliding, tangential dashpot, rolling resistance,
                        ///< unloading of the spring
  double boundary = 0;  ///< supplied by moving boundaries

  ContactWork& operator+=(const ContactWork& other) noexcept {
    damping += other.damping;
    friction += other.friction;
    boundary += other.boundary;
    return *this;
  }
};

/// Accounts for the work at the time level of the forces. The leapfrog changes 1/2 m v_{n-1/2}.v_{n+1/2}
/// between two force evaluations by exactly 1/2 (F_{n-1} + F_n).v_{n-1/2} step, so that is the work counted;
/// it needs the force of the last evaluation. The tangential part is what was put in less what the spring
/// still holds. Test: "The ledger of a damped, sliding bounce closes".
struct WorkLedger {
  /// Last damping force and tangential force; then the elastic energies of normal and tangential spring and
  /// the force along the boundary's motion.
  static constexpr int memory_rows = 2;
};

}  // namespace talus::dem
