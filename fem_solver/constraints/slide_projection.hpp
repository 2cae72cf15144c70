#pragma once

#include <span>
#include <vector>

#include "core/vector3.hpp"

namespace talus::fem {

using core::Vector3;

/// Sliders on a rope in explicit dynamics, by multi-point constraints. Source: [P eq. 8-13 and the explicit
/// form after it]; Gauss's principle of least constraint.
///
///     gap of slider k:  g = C - (1 - t) A - t B        w = B - A
///     P = I - w w^T/w.w;  I at an end of the rope
///     velocities after the free step get impulses p_k:
///         dv_C = p/m_C,  dv_A = -(1 - t) p/m_A,  dv_B = -t p/m_B
///     so that P (dg/dt + g/dt) = 0 for every slider at once,  p_k in the range of P
///
/// | symbol | variable | meaning                                                                  | unit |
/// |--------|----------|--------------------------------------------------------------------------|------|
/// | t      | fraction | where the slider's foot stands on its segment, at the step's start       | 1    |
/// | P      | across   | only what moves the slider off its line is stopped                       | 1    |
/// | p      | impulse  | what the rope does to the slider in this step                            | N s  |
/// | dt     | step     | the step's length; the offset g of the last step is taken back by this   | s    |
///
/// This equals eliminating the slave directions with residual and mass condensed, (L^T M L) a = L^T res,
/// without a choice of slave directions and with masses staying lumped. The system of the impulses is
/// symmetric, as large as there are sliders, and solved by conjugate gradients that start from zero: a step
/// depends on the state alone. Segments are searched every step, so sliders are handed over at corners; one that
/// runs past the rope's end is held at the end node until it turns back. Proven by
/// (elements_constraints.cpp): "projecting velocities equals the condensed equations of motion".
class SlideProjection {
 public:
  /// Local node order everywhere: the rope's nodes, then the sliders.
  struct Sizes {
    std::size_t rope_nodes = 0;
    std::size_t sliders = 0;
  };
  explicit SlideProjection(const Sizes& sizes);

  /// Corrects the velocities in place; does not allocate.
  /// @param positions at the step's start, 3 a node (m)
  /// @param inverse_masses of each direction, 3 a node; 0 where a support holds it (1/kg)
  /// @return false where the impulses did not converge
  /// @pre consecutive rope nodes differ, every slider or a rope node beside it can move
  struct Step {
    std::span<const double> positions;
    std::span<const double> inverse_masses;
    double length = 0;  ///< s
  };
  bool project(const Step& step, std::span<double> velocities) noexcept;

  /// Largest distance of a slider from the rope at the last step's start (m).
  double largest_violation() const noexcept;
  /// Of slider k at the last step's start.
  struct Contact {
    std::size_t segment = 0;
    double fraction = 0;
    bool at_end = false;              ///< held at the rope's first or last node
    double violation = 0;             ///< m
    Vector3 along = Vector3::Zero();  ///< unit vector of the segment
  };
  const std::vector<Contact>& contacts() const noexcept { return contacts_; }
  /// Impulse on each slider in the last step, 3 a slider (N s).
  std::span<const double> impulses() const noexcept { return impulse_; }

 private:
  void find_contacts(const Step& step, std::span<const double> velocities) noexcept;
  void spread(std::span<const double> impulses, const Step& step) noexcept;
  Vector3 relative(std::size_t slider, std::span<const double> node_values) const noexcept;
  Vector3 across(std::size_t slider, const Vector3& v) const noexcept;
  double start_residuals(const Step& step, std::span<const double> velocities) noexcept;
  bool solve_impulses(const Step& step, double enough) noexcept;
  double weighted_residual(const Step& step) const noexcept;
  double preconditioner(std::size_t slider, const Step& step) const noexcept;

  Sizes sizes_;
  std::vector<Contact> contacts_;
  std::vector<double> impulse_, residual_, direction_, product_;  ///< 3 a slider
  std::vector<double> change_;                                    ///< velocity changes, 3 a node
};

}  // namespace talus::fem
