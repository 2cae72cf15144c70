#pragma once

#include <span>
#include <vector>

#include "core/vector3.hpp"

namespace talus::fem {

using core::Vector3;

/// Which nodes slide along which ropes, in a numbering of their own.
struct SlideNetwork {
  std::size_t nodes = 0;
  std::vector<std::vector<std::size_t>> ropes;  ///< nodes along each; a closed one ends with its first node
  struct Slider {
    std::size_t node, rope;
  };
  std::vector<Slider> sliders;  ///< any node may follow several ropes, and lead others on its own
};

/// Sliders on ropes in explicit dynamics, by multi-point constraints. Source: [P eq. 8-13 and the explicit
/// form after it]; Gauss's principle of least constraint.
///
///     gap of slider k:  g = C - (1 - t) A - t B        w = B - A
///     P = I - w w^T/w.w;  I at an end of the rope
///     velocities after the free step get impulses p_k:
///         dv_C = p/m_C,  dv_A = -(1 - t) p/m_A,  dv_B = -t p/m_B
///     so that P dg/dt = 0 for every slider at once,  p_k in the range of P
///     positions after the step: the same with displacements in place of velocities, so that P g = 0
///
/// | symbol | variable | meaning                                                                  | unit |
/// |--------|----------|--------------------------------------------------------------------------|------|
/// | t      | fraction | where the slider's foot stands on its segment                            | 1    |
/// | P      | across   | only what moves the slider off its line is stopped                       | 1    |
/// | p      | impulse  | what the rope does to the slider in this step                            | N s  |
///
/// The first equals eliminating the slave directions with residual and mass condensed, (L^T M L) a = L^T res,
/// without a choice of slave directions and with masses staying lumped. What a straight step leaves of a gap
/// (its square, and what a corner turns) is taken back by positions alone, so it never becomes speed. All
/// sliders of a structure are held at once, whatever they share. The system of the impulses is symmetric, as
/// large as there are sliders, and solved by conjugate gradients that start from zero. A slider is handed over
/// at corners from one segment to the next, so finding it costs the same on any rope; one that runs past the
/// rope's end is held at the end node until it turns back. Proven by (elements_constraints.cpp): "stopping
/// velocities equals the condensed equations of motion".
class SlideProjection {
 public:
  explicit SlideProjection(SlideNetwork network);

  /// Positions, 3 a node (m), and the segment that each slider was last on, which is brought up to date.
  struct Place {
    std::span<const double> positions;
    std::span<double> segments;
  };
  /// Puts every slider's segment to the nearest of its whole rope.
  void search(const Place& at) const noexcept;

  /// Takes from the velocities what leads sliders off their ropes; does not allocate.
  /// @param inverse_masses of each direction, 3 a node; 0 where a support holds it (1/kg)
  /// @return false where the impulses did not converge
  /// @pre consecutive rope nodes differ, every slider or a rope node beside it can move
  bool stop(const Place& at, std::span<const double> inverse_masses, std::span<double> velocities) noexcept;
  /// How nodes have to be moved for every slider to be on its rope (m, 3 a node), the heavier the less.
  /// @return false where that did not converge
  bool put_back(const Place& at, std::span<const double> inverse_masses, std::span<double> moves) noexcept;

  /// Of a slider when last looked at.
  struct Contact {
    std::size_t near = 0, far = 0;  ///< nodes of its segment
    double fraction = 0;
    bool at_end = false;              ///< held at the rope's first or last node
    double violation = 0;             ///< m
    Vector3 along = Vector3::Zero();  ///< unit vector of the segment
  };
  const std::vector<Contact>& contacts() const noexcept { return contacts_; }
  const SlideNetwork& network() const noexcept { return network_; }
  /// On each slider, of the last stop(), 3 a slider (N s).
  std::span<const double> impulses() const noexcept { return impulse_; }

 private:
  /// Where a slider stands. @return -1 at or before the rope's first node, 1 at or behind its last one, else 0
  double find(const Place& at, std::size_t slider) noexcept;
  bool solve(std::span<const double> inverse_masses, double enough) noexcept;
  void spread(std::span<const double> impulses, std::span<const double> inverse_masses) noexcept;
  Vector3 relative(std::size_t slider, std::span<const double> node_values) const noexcept;
  Vector3 across(std::size_t slider, const Vector3& v) const noexcept;
  double weighted_residual(std::span<const double> inverse_masses) const noexcept;
  double preconditioner(std::size_t slider, std::span<const double> inverse_masses) const noexcept;

  SlideNetwork network_;
  std::vector<Contact> contacts_;
  std::vector<double> impulse_, residual_, direction_, product_;  ///< 3 a slider
  std::vector<double> change_;                                    ///< 3 a node
};

}  // namespace talus::fem
