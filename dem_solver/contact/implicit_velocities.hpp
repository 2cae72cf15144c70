#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "dem_solver/contact/law.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// Relative velocities at the end of the step for all contacts with a boundary of light nodes at once, so
/// that their dashpots cannot overshoot.
///
/// An explicit dashpot acts with the velocity of half a step ago. Sized by a heavy rock but acting on a light
/// node it turns that node's velocity round within one step where  dt > 2 m/c  (step limits, physics of light
/// nodes), and the accuracy is gone long before the spring's limit dt < 2 sqrt(m/k). Here springs stay at
/// t_n, dashpots take the velocity at t_n + dt/2 that the forces themselves lead to:
///
///     u_c = u_c,free + dt sum_d G_cd f_d          f_c = law(d_c(t_n), u_c)
///     normal:      Fn = max(0, (Fe - c u0)/(1 + c dt g))
///     tangential:  T  = (T0 - (kt dt + ct) u0)/(1 + (kt dt + ct) dt g_t),  |T| <= mu Fn
///
/// | symbol | variable          | meaning                                                      | unit  |
/// |--------|-------------------|--------------------------------------------------------------|-------|
/// | u      | relative velocity | of the sphere over the boundary at the contact, t_n + dt/2   | m/s   |
/// | u0     |                   | u without this contact's own force                           | m/s   |
/// | f      | force             | on the sphere, Fn n + T                                      | N     |
/// | Fe, T0 | elastic, spring   | springs at t_n                                               | N     |
/// | c, ct  | damping, ...      | dashpots                                                     | N s/m |
/// | g, g_t | response          | velocity that a unit of impulse at the contact makes there,  | 1/kg  |
/// |        |                   | along n; most along the surface                              |       |
///
/// With r from the body's centre to the contact point, an impulse p changes the velocity there by
/// (1/m + sum N_k^2/m_k) p + (I^-1 (r x p)) x r, the sum over the boundary's nodes: for a sphere arm^2/I
/// along the surface and nothing along n; for a rock the directions are coupled, so the normal force is found
/// first, then the tangential one with the largest response of any direction, which sweeps make exact.
///
/// The system is solved by sweeps over the contacts in their fixed order (Gauss-Seidel; each contact sees
/// what the others have just done), which converge because the system is that of a dissipative law: the
/// method of contact dynamics [Jean 1999, Comput. Methods Appl. Mech. Eng. 177, 235] with compliant contacts.
/// For dt -> 0 it is the explicit law. The boundary's free velocity, which its own forces lead to without
/// contact, comes from the structure. Tests: implicit_velocities_test.cpp.
class ImplicitVelocities {
 public:
  struct Control {
    /// Largest change of a force in a sweep, times 1 + c dt g, over the largest force. What a sweep leaves,
    /// df, moves a light node at dt g df, and the dashpot answers to that in the next step: without the
    /// factor a heavy rock's dashpot feeds on it and the step is unstable, however small the force is.
    double tolerance = 1e-4;
    int most_sweeps = 1000;
  };
  /// One contact as the system sees it; filled in a fixed order.
  struct Contact {
    Index body = 0;
    std::array<Index, 3> nodes{-1, -1, -1};  ///< of the boundary; -1: none
    std::array<double, 3> weights{};
    Triple<double> normal;
    Triple<double> lever{};           ///< m; from the body's centre to the contact point
    double elastic = 0, damping = 0;  ///< N, N s/m
    double tangential_stiffness = 0, tangential_damping = 0;  ///< N/m, N s/m
    double coefficient = 0;                                   ///< of friction
    Triple<double> spring{};                                  ///< N; tangential, at t_n
    Triple<double> force{};                                   ///< N; found; a guess before
    /// Of a contact that a saddle limits (ContactRule): the normal force acts there, too, reversed.
    Triple<double> saddle_normal{};  ///< zero: there is none
    Triple<double> saddle_lever{};   ///< m; from the body's centre
    std::array<Index, 3> saddle_nodes{-1, -1, -1};
    std::array<double, 3> saddle_weights{};
  };
  /// A symmetric matrix, 1/(kg m^2); zero where nothing turns the body.
  struct InverseInertia {
    Triple<double> x, y, z;  ///< rows

    Triple<double> operator*(const Triple<double>& torque) const noexcept {
      return {dot(x, torque), dot(y, torque), dot(z, torque)};
    }
  };
  /// What moves, spheres and rocks alike: velocities at t_n + dt/2 without boundary contact, moved on by what
  /// is found.
  struct Bodies {
    std::vector<Row> velocity;  ///< w: inverse mass
    std::vector<Triple<double>> spin;
    std::vector<InverseInertia> inverse_inertia;
    std::vector<Row> node_velocity;  ///< w: inverse mass
  };

  /// Finds the forces of all contacts and moves the bodies on by them.
  /// @return the sweeps that were needed; most_sweeps + 1: not converged
  static int solve(std::span<Contact> contacts, Bodies& bodies, double step, const Control& control) noexcept;

  /// u of a contact for the bodies' present velocities; where a saddle limits it, what moves that counts along the normal.
  static Triple<double> relative_velocity(const Contact& contact, const Bodies& bodies) noexcept;
};

}  // namespace talus::dem
