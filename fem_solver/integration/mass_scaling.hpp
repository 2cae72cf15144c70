#pragma once

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// What mass scaling did to a structure.
struct AddedMass {
  double kilograms = 0;
  double share = 0;  ///< of the mass before
  Index nodes = 0;   ///< that got some
};

/// Makes light nodes heavier until an explicit step is stable:
///
///     m_i = max(m_i, (sum over j of |K_ij|)/w^2)        w^2 = 4/(dt^2 + 2 b dt)
///
/// with the bounds of frequency_bound.hpp in the reference state, all that is slack taken as taut, so that no
/// frequency exceeds w, and b the factor of stiffness damping (step_limit.hpp). The added mass is mass in every
/// respect: it has inertia and weight, and contacts meet it. Proven by: "mass scaling makes the step that it is asked
/// for stable" (step_limit_test.cpp).
/// @param step dt, s; the largest that the scaled structure allows for
AddedMass scale_masses(Model& model, double step);

}  // namespace talus::fem
