#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/schemes/exchange.hpp"

/// What a strong scheme iterates on. An unknown is a vector x and the function H(x) that the two sides make
/// of it; x = H(x) where the window has converged. All are scaled to lengths, so that an acceleration may add
/// their parts up.
namespace talus::coupler {

enum class Predictor { constant, linear };
enum class FieldName { displacement, velocity, force };

/// A field of the interface before and after an iteration, for the convergence measures. Values may be
/// scaled; `unit` undoes it.
struct FieldChange {
  FieldName name;
  std::span<const double> before, after;
  double unit = 1;
};

/// x = (u, L v) of Ω_D at the window's end; particles, then structure. The variant "relax the motion" of
/// [Sautter, Teschemacher, Celigueta, Bletzinger, Wüchner 2020, Adv. Civ. Eng., 9504193].
class MotionUnknown {
 public:
  explicit MotionUnknown(Exchange& exchange);
  void predict(const Window& window, Predictor predictor);
  /// H(x): runs both sides over the window.
  void evaluate(const Window& window, int iteration);
  std::span<double> x() { return x_; }
  std::span<const double> made() const { return made_; }
  std::array<FieldChange, 3> changes(const Window& window) const;

 private:
  Exchange& exchange_;
  std::vector<double> x_, made_, force_before_;
};

/// x = (u, L v) of Ω_D at the window's end, less what its nodes answer to the contact forces with their mass
/// alone: the particles add that themselves, step by step (LightNodes). Particles, then structure; H(x) = x +
/// (structure's motion) - (where the particles took the boundary), so at the fixed point both agree.
///
/// A contact of stiffness k and dashpot c on a node of mass m changes the force by (k L^2/4m + c L/2m) times
/// what its motion is wrong by: that is the gain of "relax the motion", hundreds for the dashpot of a rock on
/// a light node. Here the node moves with the force, which then changes by at most m/L times an error of v,
/// however hard the contact. The structure answers with L/(m + L^2 K/4) where the particles assumed L/m, K
/// the structure's stiffness at the node, so the gain is (L^2 K/4)/(m + L^2 K/4), below 1 for every window.
/// It is a Robin condition on the particles' side [Badia, Nobile, Vergara 2008, J. Comput. Phys. 227, 7027].
/// Test: "a dashpot far too hard for the node's mass ..." in implicit_test.cpp.
class FreeMotionUnknown {
 public:
  explicit FreeMotionUnknown(Exchange& exchange);
  void predict(const Window& window, Predictor predictor);
  void evaluate(const Window& window, int iteration);
  std::span<double> x() { return x_; }
  std::span<const double> made() const { return made_; }
  std::array<FieldChange, 3> changes(const Window& window) const;

 private:
  Exchange& exchange_;
  std::vector<double> x_, made_, structure_motion_, boundary_motion_, force_before_;
};

/// x = f on Ω_D; structure, then particles: the variant "relax the force".
class ForceUnknown {
 public:
  explicit ForceUnknown(Exchange& exchange);
  void predict(const Window& window, Predictor predictor);
  void evaluate(const Window& window, int iteration);
  std::span<double> x() { return x_; }
  std::span<const double> made() const { return exchange_.particles().force; }
  std::array<FieldChange, 3> changes(const Window& window) const;

 private:
  Exchange& exchange_;
  std::vector<double> x_, displacement_before_, velocity_before_;
};

/// x = (u, L v, L^2/m f) of Ω_D, m a node's mean mass; both sides at the same time.
class MotionAndForceUnknown {
 public:
  MotionAndForceUnknown(Exchange& exchange, double node_mass);
  void predict(const Window& window, Predictor predictor);
  void evaluate(const Window& window, int iteration);
  std::span<double> x() { return x_; }
  std::span<const double> made() const { return made_; }
  std::array<FieldChange, 3> changes(const Window& window) const;

 private:
  double force_scale(const Window& window) const { return window.length() * window.length() / node_mass_; }
  Exchange& exchange_;
  double node_mass_;
  std::vector<double> x_, made_, force_;
};

}  // namespace talus::coupler
