#include "fem_solver/materials/principal_wrinkles.hpp"

namespace talus::fem {

double PrincipalWrinkles::energy_density(const PlaneStrain<double>& carried) const noexcept {
  return 0.5 * work(stress(carried, elasticity_.stress(carried), true), carried);
}

PlaneMatrix PrincipalWrinkles::tangent(const PlaneStrain<double>& carried) const noexcept {
  const PlaneStress<double> trial = elasticity_.stress(carried);
  const PlaneMatrix C = elasticity_.stiffness();
  const PlaneVector s = to_vector(trial), U = to_vector(wrinkle(trial));
  const double cosine = U[0] - U[1], sine = U[2];
  // dU/dp for the doubled angle p of n, and dp/ds = (-b, b, 2a)/(a^2 + b^2) with a = s_xx - s_yy, b = 2 s_xy
  const PlaneVector U1(-0.5 * sine, 0.5 * sine, cosine);
  const double a = s[0] - s[1], b = 2 * s[2], size_square = a * a + b * b;
  const PlaneVector CU = C * U, CU1 = C * U1;
  const double N = U.dot(s), N1 = U1.dot(s), D = U.dot(CU), D1 = 2 * U1.dot(CU);
  PlaneMatrix tangent = C - CU * CU.transpose() / D;
  if (size_square > 0) {
    const PlaneVector turning = C * PlaneVector(-b, b, 2 * a) / size_square;
    const PlaneVector stress_change = -((N1 - N * D1 / D) / D * CU + N / D * CU1);
    tangent += stress_change * turning.transpose();
  }
  return tangent;
}

}  // namespace talus::fem
