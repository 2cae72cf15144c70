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

struct MpcRun {
  std::vector<Vector3> path;
  double largest_violation = 0;
};

/// The same rope as plain cables with light nodes, the slider held on it by constraints.
MpcRun path_on_cables(double step, Eigen::Index segments) {
  const Eigen::Index rope_nodes = segments + 1, slider = rope_nodes;
  const double L = span / static_cast<double>(segments),
               node_mass = 0.5 / static_cast<double>(segments);  // 0.5 kg of rope
  Eigen::VectorXd x(3 * (rope_nodes + 1)), v = Eigen::VectorXd::Zero(x.size()), inverse(x.size());
  for (Eigen::Index k = 0; k < rope_nodes; ++k)
    x.segment<3>(3 * k) = Vector3(static_cast<double>(k) * L, 0, 0);
  x.segment<3>(3 * slider) = start;
  v.segment<3>(3 * slider) = velocity;
  inverse.setConstant(1 / node_mass);
  inverse.head<3>().setZero();
  inverse.segment<3>(3 * segments).setZero();
  inverse.tail<3>().setConstant(1 / slider_mass);
  SlideProjection slide({static_cast<std::size_t>(rope_nodes), 1});
  MpcRun run;
  for (int n = 0; n < static_cast<int>(end_time / step); ++n) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(x.size());
    f.tail<3>() = weight;
    for (Eigen::Index e = 0; e < segments; ++e) {
      const Vector3 D(L, 0, 0), w = x.segment<3>(3 * e + 3) - x.segment<3>(3 * e) - D;
      const Vector3 force = AxialElement<TensionOnly>{D, 1 / L, {1, EA, S0 * EA}}.force(w);
      f.segment<3>(3 * e) += force;
      f.segment<3>(3 * e + 3) -= force;
    }
    f.head(3 * rope_nodes) -=
        2.0 * node_mass * v.head(3 * rope_nodes);  // takes the ringing out of the light nodes
    v += step * inverse.cwiseProduct(f);
    REQUIRE(
        slide.project({span_of(x), span_of(inverse), step}, {v.data(), static_cast<std::size_t>(v.size())}));
    x += step * v;
    run.path.push_back(x.tail<3>());
    run.largest_violation = std::max(run.largest_violation, slide.largest_violation());
  }
  return run;
}

}  // namespace

TEST_CASE("a slider takes the same path on a sliding cable and on cables with constraints") {
  const double step = 2.5e-5;  // of 4e-5, which a wave takes along a segment
  const std::vector<Vector3> one_element = path_on_sliding_cable(step);
  const MpcRun constrained = path_on_cables(step, 80);
  double distance = 0, travelled = 0;
  for (std::size_t n = 0; n < one_element.size(); ++n) {
    distance = std::max(distance, (one_element[n] - constrained.path[n]).norm());
    travelled = std::max(travelled, (one_element[n] - start).norm());
  }
  CAPTURE(distance, travelled, constrained.largest_violation);
  CHECK(travelled > 0.5);
  CHECK(distance < 0.01 * travelled);
  CHECK(constrained.largest_violation < 1e-3);
}
