#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "fem_solver/elements/membrane.hpp"
#include "fem_solver/materials/exact_wrinkles.hpp"
#include "fem_solver/materials/principal_wrinkles.hpp"
#include "fem_solver/materials/tension_field.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using talus::test::Dice;

namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

std::array<Triple<double>, 2> relative(const Eigen::VectorXd& u) {
  const Vector3 w1 = u.segment<3>(3) - u.segment<3>(0), w2 = u.segment<3>(6) - u.segment<3>(0);
  return {{{w1[0], w1[1], w1[2]}, {w2[0], w2[1], w2[2]}}};
}

template <class Law>
double energy(const MembraneTriangle<double>& triangle, const Law& law, const Eigen::VectorXd& u) {
  return triangle.volume * law.energy_density(triangle.deform(relative(u)).strain);
}

template <class Law>
Eigen::VectorXd force(const MembraneTriangle<double>& triangle, const Law& law, const Eigen::VectorXd& u) {
  const auto deformation = triangle.deform(relative(u));
  const auto [f1, f2] = triangle.force(deformation, law.stress(deformation.strain));
  Vector9 f;
  f << -f1.x - f2.x, -f1.y - f2.y, -f1.z - f2.z, f1.x, f1.y, f1.z, f2.x, f2.y, f2.z;
  return f;
}

template <class Law>
Matrix9 stiffness(const MembraneTriangle<double>& triangle, const Law& law, const Eigen::VectorXd& u) {
  const auto deformation = triangle.deform(relative(u));
  return membrane_stiffness(triangle, deformation, law.stress(deformation.strain),
                            law.tangent(deformation.strain));
}

MembranePatch random_patch(Dice& dice) {
  return {
      {dice.vector(1), Vector3(2, 0.1, 0.3) + dice.vector(0.5), Vector3(0.2, 1.5, -0.4) + dice.vector(0.5)},
      0.01,
      Vector3(0.7, 0.4, 0.1)};
}

const PlaneElasticity net = PlaneElasticity::from(OrthotropicSheet{3e3, 1e3, 0.2, 500});

/// Force and stiffness against differences of the energy and the force, at random large deformations.
template <class Law>
void check_derivatives(const Law& law, unsigned seed) {
  Dice dice(seed);
  for (int trial = 0; trial < 60; ++trial) {
    const MembraneTriangle<double> triangle = membrane_triangle(random_patch(dice));
    Vector9 u;
    u << dice.vector(0.3), dice.vector(0.3), dice.vector(0.3);
    const double scale = 3e3 * triangle.volume;
    // Steps of 1e-6 m on metres: round-off over step 1e-10, curvature times step^2 1e-12, both times the
    // modulus.
    const auto U = [&](const Eigen::VectorXd& x) { return test::as_vector(energy(triangle, law, x)); };
    const auto f = [&](const Eigen::VectorXd& x) { return force(triangle, law, x); };
    if constexpr (!std::is_same_v<Law, TensionField<PrincipalWrinkles>>)
      CHECK((test::central_differences(U, u, 1e-6).transpose() - force(triangle, law, u)).norm() <
            1e-8 * scale);
    CHECK((test::central_differences(f, u, 1e-6) - stiffness(triangle, law, u)).norm() < 1e-7 * scale);
  }
}

}  // namespace

TEST_CASE("the force of a membrane is the derivative of its energy and its stiffness that of its force") {
  const PlaneStress<double> prestress{100, 50, 10};
  check_derivatives(LinearSheet(net, prestress), 21);
  check_derivatives(TensionField<ExactWrinkles>(net, prestress), 22);
  check_derivatives(TensionField<PrincipalWrinkles>(net, prestress), 23);
}

TEST_CASE("turning a membrane turns its force and leaves its energy") {
  Dice dice(24);
  const TensionField<ExactWrinkles> law(net, {100, 50, 10});
  for (int trial = 0; trial < 100; ++trial) {
    const MembranePatch patch = random_patch(dice);
    const MembraneTriangle<double> triangle = membrane_triangle(patch);
    const Eigen::Matrix3d R = dice.rotation();
    Vector9 X, u;
    X << patch.nodes[0], patch.nodes[1], patch.nodes[2];
    u << dice.vector(0.3), dice.vector(0.3), dice.vector(0.3);
    const Eigen::VectorXd turned_u = test::turned(R, X + u) - X;
    const double scale = 3e3 * triangle.volume;
    CHECK((force(triangle, law, turned_u) - test::turned(R, force(triangle, law, u))).norm() < 1e-12 * scale);
    CHECK(std::abs(energy(triangle, law, turned_u) - energy(triangle, law, u)) < 1e-12 * scale);
  }
}

TEST_CASE("membrane forces sum to zero and have no moment") {
  Dice dice(25);
  const TensionField<ExactWrinkles> law(net, {100, 50, 10});
  for (int trial = 0; trial < 100; ++trial) {
    const MembranePatch patch = random_patch(dice);
    const MembraneTriangle<double> triangle = membrane_triangle(patch);
    Vector9 u;
    u << dice.vector(0.3), dice.vector(0.3), dice.vector(0.3);
    const Vector9 f = force(triangle, law, u);
    Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vector3 x = patch.nodes[static_cast<std::size_t>(i)] + u.segment<3>(3 * i);
      sum += f.segment<3>(3 * i);
      moment += x.cross(Vector3(f.segment<3>(3 * i)));
    }
    CHECK(sum.norm() <= 1e-13 * f.norm());
    CHECK(moment.norm() <= 1e-13 * f.norm() * 4);  // arms of up to 4 m
  }
}

TEST_CASE("a triangle of a steel sheet has a third of its mass at each node") {
  // (0,0),(2,0),(2,1), t 0.01, rho 7850: area 1
  const MembraneTriangle<double> triangle =
      membrane_triangle({{Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(2, 1, 0)}, 0.01, {}});
  CHECK(membrane_node_mass(triangle.volume, 7850) == Approx(7850 * 0.01 * 1.0 / 3).epsilon(1e-14));
}

TEST_CASE("a homogeneous deformation gives the strain of its gradient in the material axes of any triangle") {
  Dice dice(26);
  const Vector3 axis = Vector3(2, 1, 0).normalized(), across(-axis[1], axis[0], 0);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 0) = 1.1, F(0, 1) = 0.2, F(1, 0) = -0.05, F(1, 1) = 0.95, F(2, 0) = 0.3;
  const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
  for (int trial = 0; trial < 50; ++trial) {
    const auto flat = [&] { return Vector3(dice.uniform(-1, 1), dice.uniform(-1, 1), 0); };
    MembranePatch patch{{flat(), flat(), flat()}, 1, axis * 3};
    const double turn = (patch.nodes[1] - patch.nodes[0]).cross(patch.nodes[2] - patch.nodes[0])[2];
    if (turn < 0) std::swap(patch.nodes[1], patch.nodes[2]);
    if (std::abs(turn) < 0.1) continue;
    Vector9 u;
    for (int i = 0; i < 3; ++i) {
      const Vector3& X = patch.nodes[static_cast<std::size_t>(i)];
      u.segment<3>(3 * i) = F * X - X + Vector3(5, 6, 7);
    }
    const PlaneStrain<double> e = membrane_triangle(patch).deform(relative(u)).strain;
    const PlaneVector expected(axis.dot(E * axis), across.dot(E * across), 2 * axis.dot(E * across));
    CHECK((to_vector(e) - expected).norm() < 1e-13);
  }
}

TEST_CASE("the law of Münsch and Reinhardt is symmetric and its inverse shows the contraction asked for") {
  const OrthotropicSheet sheet{4e9, 1e9, 0.2, 3e8};
  const PlaneElasticity law = PlaneElasticity::from(sheet);
  const double vyx = 0.2 * 4e9 / 1e9, Q = 1 - 0.2 * vyx;
  PlaneMatrix printed;  // [P eq. 14]
  printed << 4e9, 0.2 * 4e9, 0, vyx * 1e9, 1e9, 0, 0, 0, Q * 3e8;
  CHECK(law.stiffness().isApprox(printed / Q, 1e-14));
  CHECK((law.stiffness() * law.compliance()).isApprox(PlaneMatrix::Identity(), 1e-14));
  // pulled along y it contracts along x by v_xy times the strain along y
  const PlaneStrain<double> pulled = law.strain(PlaneStress<double>{0, 1e6, 0});
  CHECK(-pulled.xx / pulled.yy == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("sheets that are not positive definite are refused with their numbers") {
  using Catch::Matchers::Contains;
  const auto refusal = [](const OrthotropicSheet& sheet) {
    try {
      PlaneElasticity::from(sheet);
    } catch (const core::ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal({4e9, 1e9, 0.5, 3e8}), Contains("sqrt(E_y/E_x) = 0.5"));
  CHECK_THAT(refusal({4e9, 1e9, -0.6, 3e8}), Contains("but is -0.6"));
  CHECK_THAT(refusal({0, 1e9, 0.1, 3e8}), Contains("youngs_modulus_x"));
  CHECK_THAT(refusal({1e9, 1e9, 0.1, -1}), Contains("shear_modulus"));
  CHECK(refusal({4e9, 1e9, 0.499, 3e8}) == "accepted");
  CHECK_THROWS_AS(PlaneElasticity::from(IsotropicSheet{1e9, 1.0}), core::ConfigError);
  CHECK_THROWS_AS(PlaneElasticity::from(IsotropicSheet{-1e9, 0.3}), core::ConfigError);
  CHECK(is_poisson_pair({4e9, 1e9, 0.2, 3e8}, 0.8));
  CHECK_FALSE(is_poisson_pair({4e9, 1e9, 0.2, 3e8}, 0.05));
}

TEST_CASE("a triangle without area or with an upright material axis is refused with its place") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(membrane_triangle({{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)}, 1, {}}),
                    Contains("(2, 0, 0)"));
  CHECK_THROWS_WITH(
      membrane_triangle({{Vector3(5, 0, 0), Vector3(6, 0, 0), Vector3(5, 1, 0)}, 1, Vector3(0, 0, 1)}),
      Contains("(5, 0, 0)"));
}
