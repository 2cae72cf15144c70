#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/constraints/penalty_sliding.hpp"
#include "fem_solver/constraints/slide_projection.hpp"
#include "fem_solver/elements/sliding_cable.hpp"
#include "tests/unit/fem_solver/ropes.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

TEST_CASE("a weight on a stiff rope between two supports settles at the lowest point of the ellipse") {
  // Both pieces hang at the same angle a to the vertical: sin a = span/L; drops d1 + d2 = L cos a, d1 - d2 =
  // rise.
  const double span = 3, rise = 0.8, L = 5, weight = 500, EA = 1e8;
  const double cosine = std::sqrt(1 - span * span / (L * L)), drop = 0.5 * (L * cosine - rise);
  const Vector3 expected(drop / cosine * span / L, 0, -drop);
  const SlidingCable rope{RopeLaw({1, EA, 0}), L, 1e-3};
  Eigen::VectorXd x(9);
  x << 0, 0, 0, 1, 0, -1.5, span, 0, rise;
  for (int step = 0; step < 200; ++step) {  // damped Newton in the slider's plane
    const Eigen::VectorXd f = sliding_force(rope, x);
    const Eigen::MatrixXd K =
        nodal_stiffness(9, [&](const auto& sink) { rope.stiffness(chords_of(x), sink); });
    const Vector3 residual = Vector3(0, 0, -weight) - Vector3(f.segment<3>(3));
    Eigen::Matrix3d tangent = K.block<3, 3>(3, 3) + 1e-3 * EA * Eigen::Matrix3d::Identity() *
                                                        (rope.tension(chords_of(x)) > 0 ? 1e-6 : 1);
    Vector3 move = tangent.inverse() * residual;
    if (move.norm() > 0.1) move *= 0.1 / move.norm();
    x.segment<3>(3) += move;
  }
  // The rope stretches by N/EA = weight/(2 cos a EA) ~ 3e-6 of its length.
  CHECK((x.segment<3>(3) - expected).norm() < 2e-5 * L);
  CHECK(rope.tension(chords_of(x)) == Approx(weight / (2 * cosine)).epsilon(1e-4));
}

namespace {

constexpr double EA = 2e5, S0 = 0.01, span = 4, slider_mass = 20;  // N, prestrain, m, kg
const Vector3 start(1.2, 0, 0), velocity(1.5, 0, -1.0), weight(0, 0, -50);
constexpr double end_time = 0.8;

/// The slider's path on a rope that is one element: two fixed ends and the slider.
std::vector<Vector3> path_on_sliding_cable(double step) {
  const SlidingCable rope{RopeLaw({1, EA, S0 * EA}), span, 1e-3};
  Eigen::VectorXd x(9);
  x << 0, 0, 0, start, span, 0, 0;
  Vector3 v = velocity;
  std::vector<Vector3> path;
  for (int n = 0; n < static_cast<int>(end_time / step); ++n) {
    v += step / slider_mass * (weight - Vector3(sliding_force(rope, x).segment<3>(3)));
    x.segment<3>(3) += step * v;
    path.push_back(x.segment<3>(3));
  }
  return path;
}

/// The same rope as plain cables with light nodes, the slider held on it by constraints.
class CablesAndSlider {
 public:
  explicit CablesAndSlider(Eigen::Index segments)
      : segments_(segments),
        length_(span / static_cast<double>(segments)),
        position_(Eigen::VectorXd::Zero(3 * (segments + 2))),
        velocity_(position_),
        inverse_mass_(position_.size()),
        slide_(network(static_cast<std::size_t>(segments + 1))) {
    for (Eigen::Index k = 0; k <= segments; ++k) position_[3 * k] = static_cast<double>(k) * length_;
    position_.tail<3>() = start;
    velocity_.tail<3>() = velocity;
    inverse_mass_.setConstant(static_cast<double>(segments) / rope_mass);
    inverse_mass_.head<3>().setZero();
    inverse_mass_.segment<3>(3 * segments).setZero();
    inverse_mass_.tail<3>().setConstant(1 / slider_mass);
    slide_.search({span_of(position_), {&segment_, 1}});
  }

  /// Time that a wave takes along a segment: the step limit of the rope alone (s).
  double wave_limit() const { return length_ / std::sqrt(EA / (rope_mass / span)); }

  /// Leapfrog. @returns the energy half-way: kinetic and rope's at the start of the step, the weight's there
  double step(double step) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(position_.size());
    force.tail<3>() = weight;
    double energy = -weight.dot(slider());
    for (Eigen::Index e = 0; e < segments_; ++e) {
      const Vector3 D(length_, 0, 0), w = position_.segment<3>(3 * e + 3) - position_.segment<3>(3 * e) - D;
      const AxialElement<TensionOnly> cable{D, 1 / length_, {1, EA, S0 * EA}};
      energy += cable.energy(w);
      force.segment<3>(3 * e) += cable.force(w);
      force.segment<3>(3 * e + 3) -= cable.force(w);
    }
    const Eigen::VectorXd before = velocity_;
    velocity_ += step * inverse_mass_.cwiseProduct(force);
    const SlideProjection::Place now{span_of(position_), {&segment_, 1}};
    REQUIRE(slide_.stop(now, span_of(inverse_mass_),
                        {velocity_.data(), static_cast<std::size_t>(velocity_.size())}));
    for (Eigen::Index i = 0; i < before.size(); ++i)
      if (inverse_mass_[i] > 0) energy += 0.5 * before[i] * velocity_[i] / inverse_mass_[i];
    position_ += step * velocity_;
    Eigen::VectorXd moves(position_.size());
    REQUIRE(
        slide_.put_back(now, span_of(inverse_mass_), {moves.data(), static_cast<std::size_t>(moves.size())}));
    position_ += moves;
    largest_violation_ = std::max(largest_violation_, slide_.contacts()[0].violation);
    return energy;
  }

  Vector3 slider() const { return position_.tail<3>(); }
  double largest_violation() const { return largest_violation_; }

 private:
  static SlideNetwork network(std::size_t rope_nodes) {
    SlideNetwork network{.nodes = rope_nodes + 1, .ropes = {{}}, .sliders = {{rope_nodes, 0}}};
    for (std::size_t k = 0; k < rope_nodes; ++k) network.ropes[0].push_back(k);
    return network;
  }

  static constexpr double rope_mass = 0.5;  // kg
  Eigen::Index segments_;
  double length_;
  Eigen::VectorXd position_, velocity_, inverse_mass_;  // rope nodes, then the slider
  SlideProjection slide_;
  double segment_ = 0;
  double largest_violation_ = 0;
};

}  // namespace

TEST_CASE(
    "a slider takes the same path on a sliding cable and on cables with constraints, and loses no energy") {
  // 20 kg cross 24 corners of a rope whose nodes weigh 13 g. A corner takes what brings its node to speed,
  // 1e-2 kg (v sin(bend))^2 < 1e-4 J; leapfrog errs by the square of step times frequency of the slider.
  const double path_tolerance = 0.01, energy_tolerance = 1e-3;
  CablesAndSlider cables(40);
  const double step = 0.6 * cables.wave_limit();
  const double kinetic_at_start = 0.5 * slider_mass * velocity.squaredNorm();
  double distance = 0, travelled = 0, first_energy = 0, energy_drift = 0;
  for (const Vector3& expected : path_on_sliding_cable(step)) {
    const double energy = cables.step(step);
    if (travelled == 0) first_energy = energy;
    energy_drift = std::max(energy_drift, std::abs(energy - first_energy));
    distance = std::max(distance, (cables.slider() - expected).norm());
    travelled = std::max(travelled, (expected - start).norm());
  }
  CAPTURE(distance, travelled, cables.largest_violation());
  CHECK(travelled > 1);
  CHECK(distance < path_tolerance * travelled);
  CHECK(energy_drift < energy_tolerance * kinetic_at_start);
  // a slider is past a corner before the next segment holds it: step times speed times the sine of the bend
  const double steepest_bend = 0.2;
  CHECK(cables.largest_violation() < steepest_bend * step * velocity.norm());
}
