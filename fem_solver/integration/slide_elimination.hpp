#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem_solver/assembly/sparse_stiffness.hpp"
#include "fem_solver/constraints/slide_constraint.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Newton's equations where sliders follow ropes by multi-point constraints [P eq. 8-13 and the implicit form
/// after it]:
///
///     u_b = F_b(u) for every follower b        L = du/du_m
///     f_m = L^T f        K_m = L^T K L - sum_b f_b d2F_b/du_m2
///
/// | symbol | variable  | meaning                                                                  | unit |
/// |--------|-----------|--------------------------------------------------------------------------|------|
/// | u_b    | follower  | a direction in which a slider stays on its rope                          | m    |
/// | u_m    | masters   | directions of the rope's nodes, and the slider's own along the rope      | m    |
/// | f      | residual  | f_b is what the constraint of follower b has to carry                    | N    |
/// | K      | tangent   | of the structure without constraints                                     | N/m  |
///
/// The last term of K_m, which the paper leaves out, gives Newton its quadratic convergence. Followers keep
/// their equations, as ones on the diagonal without a force, so that the numbering stays.
///
/// On the way a slider goes no further than to the end of its segment. There it is held, as a follower of
/// that node in all directions, as long as forces press it into the corner from both sides (at the rope's end
/// from one); else it goes on along the neighbour. Corners are where weights come to rest: inside a segment
/// their equilibrium is unstable, since a rope sinks deepest under a load at a node. Tests: "Newton converges
/// quadratically ...", "a weight on a polygon rests in the corner ..." (slide_elimination_test.cpp).
class SlideElimination {
 public:
  /// Ropes may run on ropes, in turn. @throws core::ConfigError where a slider is supported, or runs on two ropes, or
  /// ropes run on each other in a circle
  SlideElimination(const Model& model, const Equations& equations);

  /// Puts every slider onto the nearest place of its rope.
  void start(std::span<double> displacement);
  /// Puts sliders back onto their ropes, after masters have moved.
  void follow(std::span<double> displacement);
  /// Decides at the corners, notes what constraints carry, and carries it over.
  void settle(std::span<const double> displacement, std::span<double> residual);
  /// f_m = L^T f, in place: followers give their force to their masters, supported ones included.
  void carry_over(std::span<double> force) const;
  /// The followers' rates as those of their masters ask for, 3 a node.
  void lead(std::span<double> rates) const;
  /// L^T A L, and K_m, which has the curvature of the constraints too. @param matrix lower half, as is the result
  SparseMatrix condense(const SparseMatrix& matrix) const;
  SparseMatrix condense_with_curvature(const SparseMatrix& tangent) const;

  bool exists() const { return !sliders_.empty(); }
  /// Largest distance of a slider of slide number `slide` from its rope (m).
  double gap(std::size_t slide, std::span<const double> displacement) const;

  /// Where the sliders are; to go back to, where a step turns out too long.
  struct Slider {
    const SlideLine* line;
    Index node;
    std::size_t segment = 0;
    std::optional<std::size_t> corner{};  ///< the rope node it stands at
    bool held = false;
  };
  const std::vector<Slider>& places() const { return sliders_; }
  void return_to(const std::vector<Slider>& places) { sliders_ = places; }

 private:
  struct Follower {
    std::size_t direction;
    std::array<std::size_t, 5> masters;
    std::array<double, 5> weights;
    std::size_t count;  ///< of masters
    void carry(std::span<double> force) const;
  };

  /// @param unit on the diagonal of followers (N/m)
  SparseMatrix condense(const SparseMatrix& matrix, double unit) const;
  Vector3 position(std::span<const double> displacement, Index node) const;
  void put(const Slider& slider, const Vector3& place, std::span<double> displacement) const;
  SlideConstraint constraint(std::span<const double> displacement, const Slider& slider) const;
  void leave_corner(std::span<const double> displacement, const Vector3& force, Slider& slider) const;
  void add_followers(const Slider& slider, const SlideConstraint& constraint);
  void add_followers_of_corner(const Slider& slider);
  /// @param force on the slider, N: what its followers carry turns with the rope
  void add_curvature(const Slider& slider, const SlideConstraint& constraint, const Vector3& force);

  const Model& model_;
  const Equations& equations_;
  std::vector<Slider> sliders_;  ///< those of ropes that others run on first
  std::vector<Follower> followers_;
  std::vector<Eigen::Triplet<double>> curvature_;  ///< of the constraints, lower half, by equations (N/m)
};

}  // namespace talus::fem
