#include "fem_solver/materials/exact_wrinkles.hpp"

namespace talus::fem {

double ExactWrinkles::energy_density(const PlaneStrain<double>& carried) const noexcept {
  const PlaneStress<double> s = stress(carried, elasticity_.stress(carried), true);
  return 0.5 * work(s, carried);
}

PlaneMatrix ExactWrinkles::tangent(const PlaneStrain<double>& carried) const noexcept {
  const DoubledAngle<double> p = tension_direction(carried, true);
  const double r = stretch_, r2 = stretch_square_;
  const PlaneVector d = to_vector(carried);
  const PlaneMatrix S = elasticity_.compliance();
  // V and its derivatives with respect to p
  const PlaneVector V(1 + p.cosine, r2 * (1 - p.cosine), r * p.sine);
  const PlaneVector V1(-p.sine, r2 * p.sine, r * p.cosine);
  const PlaneVector V2(-p.cosine, r2 * p.cosine, -r * p.sine);
  const PlaneVector SV = S * V;
  const double N = V.dot(d), N1 = V1.dot(d), N2 = V2.dot(d);
  const double D = V.dot(SV), D1 = 2 * V1.dot(SV), D2 = 2 * (V2.dot(SV) + V1.dot(S * V1));
  // h = N^2/(2 D) with s = N/D:  h_d = s V,  h_dp = s' V + s V',  h_pp = s'(N' - s D') + s N'' - s^2 D''/2
  const double s = N / D, s1 = (N1 - s * D1) / D;
  const PlaneVector h_dp = s1 * V + s * V1;
  const double h_pp = s1 * (N1 - s * D1) + s * N2 - 0.5 * s * s * D2;
  PlaneMatrix tangent = V * V.transpose() / D;
  if (h_pp < 0) tangent -= h_dp * h_dp.transpose() / h_pp;
  return tangent;
}

}  // namespace talus::fem
