#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

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
