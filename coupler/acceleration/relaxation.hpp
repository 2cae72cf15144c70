#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

/// How a strong scheme goes on from an iterate x to the next, given what the two sides made of it, H(x). All
/// of them look for the fixed point x = H(x); the residual is r = H(x) - x.
///
/// An acceleration is a type with
///     void begin_window();                                              the next update is a window's first
///     void update(std::span<double> x, std::span<const double> made);   x becomes the next iterate
///     void step_aside();                                                x went on without it: its last residual is
///                                                                       not the one that x was stepped from
///     void forget();                                                    of windows of another length: what
///     was
///                                                                       learnt in them does not hold
///     void archive(core::StateArchive& archive);   writes or reads what later windows depend on
namespace talus::core {
class StateArchive;
}

namespace talus::coupler {

/// x' = H(x): the plain Gauss-Seidel (or Jacobi) iteration.
struct NoAcceleration {
  void begin_window() {}
  void update(std::span<double> x, std::span<const double> made) {
    std::copy(made.begin(), made.end(), x.begin());
  }
  void step_aside() {}
  void forget() {}
  void archive(core::StateArchive&) {}
};

/// x' = x + w r with a constant w.
struct FixedRelaxation {
  double factor = 0.5;
  void begin_window() {}
  void update(std::span<double> x, std::span<const double> made) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * (made[i] - x[i]);
  }
  void step_aside() {}
  void forget() {}
  void archive(core::StateArchive&) {}
};

/// Aitken's dynamic relaxation for vectors [Irons, Tuck 1969, Int. J. Numer. Meth. Engng 1, 275; Küttler,
/// Wall 2008, Comput. Mech. 43, 61, eq. 45]:
///
///     x' = x + w_k r_k        w_k = -w_k-1  r_k-1 . (r_k - r_k-1) / |r_k - r_k-1|^2
///
/// | symbol | variable  | meaning                             | unit        | range                     |
/// |--------|-----------|-------------------------------------|-------------|---------------------------|
/// | w      | factor_   | relaxation of this iteration        | 1           | any sign; |w| <= largest  |
/// | r      | residual_ | H(x) - x of the last iteration      | that of x   | x's size                  |
///
/// A window's first factor is the last one's of the window before, not above `initial`, in magnitude. For one
/// linear unknown the second step is exact ("Aitken finds the fixed point of one linear unknown in two steps"
/// in acceleration_test.cpp).
class Aitken {
 public:
  explicit Aitken(double initial_factor) : initial_(initial_factor), factor_(initial_factor) {}

  void begin_window() { residual_.clear(); }
  void step_aside() { residual_.clear(); }
  void update(std::span<double> x, std::span<const double> made);
  void forget() { factor_ = initial_; }
  double factor() const { return factor_; }
  void archive(core::StateArchive& archive);

 private:
  double next_factor(std::span<const double> x, std::span<const double> made) const;

  double initial_, factor_;
  std::vector<double> residual_;
};

}  // namespace talus::coupler
