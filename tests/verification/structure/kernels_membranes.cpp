#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/elements/membrane.hpp"
#include "fem_solver/materials/exact_wrinkles.hpp"
#include "fem_solver/materials/principal_wrinkles.hpp"
#include "fem_solver/materials/tension_field.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using talus::test::Dice;

namespace {

constexpr double edge = 1.2;  // m
constexpr int fields = 4;     // a side

/// A square of distorted triangles in the plane z = 0, inner nodes moved at random; the material axis is
/// slanted.
struct Sheet {
  std::vector<Vector3> nodes;
  std::vector<std::array<int, 3>> cells;
  std::vector<MembraneTriangle<double>> triangles;

  Sheet(unsigned seed, const Vector3& axis) {
    Dice dice(seed);
    for (int j = 0; j <= fields; ++j)
      for (int i = 0; i <= fields; ++i) {
        const bool inner = i > 0 && i < fields && j > 0 && j < fields;
        const double h = edge / fields, wander = inner ? 0.3 * h : 0;
        nodes.emplace_back(i * h + dice.uniform(-wander, wander), j * h + dice.uniform(-wander, wander), 0);
      }
    for (int j = 0; j < fields; ++j)
      for (int i = 0; i < fields; ++i) {
        const int a = j * (fields + 1) + i, b = a + 1, c = a + fields + 1, d = c + 1;
        const bool rising = (i + j) % 2 == 0;
        cells.push_back(rising ? std::array{a, b, d} : std::array{a, b, c});
        cells.push_back(rising ? std::array{a, d, c} : std::array{b, d, c});
      }
    for (const auto& [a, b, c] : cells)
      triangles.push_back(membrane_triangle({{nodes[at(a)], nodes[at(b)], nodes[at(c)]}, 1e-3, axis}));
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  template <class Law>
  void assemble(const Law& law, const Eigen::VectorXd& u, Eigen::VectorXd& f, Eigen::MatrixXd& K) const {
    f = Eigen::VectorXd::Zero(u.size());
    K = Eigen::MatrixXd::Zero(u.size(), u.size());
    for (std::size_t e = 0; e < cells.size(); ++e) {
      const auto& [a, b, c] = cells[e];
      const Vector3 w1 = u.segment<3>(3 * b) - u.segment<3>(3 * a),
                    w2 = u.segment<3>(3 * c) - u.segment<3>(3 * a);
      const auto state = triangles[e].deform({{{w1[0], w1[1], w1[2]}, {w2[0], w2[1], w2[2]}}});
      const PlaneStress<double> s = law.stress(state.strain);
      const auto [f1, f2] = triangles[e].force(state, s);
      const Vector3 F1(f1.x, f1.y, f1.z), F2(f2.x, f2.y, f2.z);
      f.segment<3>(3 * a) -= F1 + F2;
      f.segment<3>(3 * b) += F1;
      f.segment<3>(3 * c) += F2;
      const Matrix9 k = membrane_stiffness(triangles[e], state, s, law.tangent(state.strain));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          K.block<3, 3>(3 * cells[e][at(i)], 3 * cells[e][at(j)]) += k.block<3, 3>(3 * i, 3 * j);
    }
  }

  /// Newton's method on the degrees of freedom for which `is_free` holds; the others keep their value.
  template <class Law, class Free>
  Eigen::VectorXd solve(const Law& law, Eigen::VectorXd u, const Free& is_free) const {
    Eigen::VectorXd f;
    Eigen::MatrixXd K;
    for (int step = 0; step < 25; ++step) {
      assemble(law, u, f, K);
      for (Eigen::Index i = 0; i < u.size(); ++i)
        if (!is_free(i / 3, i % 3)) {
          K.row(i).setZero();
          K.col(i).setZero();
          K(i, i) = 1;
          f[i] = 0;
        }
      u -= K.partialPivLu().solve(f);
    }
    return u;
  }
  bool on_rim(Eigen::Index node) const {
    const Vector3& X = nodes[static_cast<std::size_t>(node)];
    return X[0] == 0 || X[1] == 0 || X[0] == edge || X[1] == edge;
  }
};

template <class Law>
void check_patch(const Law& law) {
  const Vector3 axis = Vector3(2, 1, 0).normalized(), across(-axis[1], axis[0], 0);
  const Sheet sheet(81, axis);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();  // taut both ways
  F(0, 0) = 1.05, F(0, 1) = 0.01, F(1, 0) = 0.02, F(1, 1) = 1.08;
  Eigen::VectorXd u(3 * static_cast<Eigen::Index>(sheet.nodes.size()));
  for (std::size_t i = 0; i < sheet.nodes.size(); ++i)
    u.segment<3>(3 * static_cast<Eigen::Index>(i)) = F * sheet.nodes[i] - sheet.nodes[i];
  Eigen::VectorXd start = u;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (!sheet.on_rim(i / 3) && i % 3 < 2) start[i] = 0;
  const Eigen::VectorXd solved = sheet.solve(law, start, [&](Eigen::Index node, Eigen::Index axis_index) {
    return !sheet.on_rim(node) && axis_index < 2;
  });
  CHECK((solved - u).norm() < 1e-13);  // round-off: the linear field is exact
  const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
  const PlaneStress<double> expected =
      law.stress(PlaneStrain<double>{axis.dot(E * axis), across.dot(E * across), 2 * axis.dot(E * across)});
  for (std::size_t e = 0; e < sheet.cells.size(); ++e) {
    const auto& [a, b, c] = sheet.cells[e];
    const Vector3 w1 = solved.segment<3>(3 * b) - solved.segment<3>(3 * a),
                  w2 = solved.segment<3>(3 * c) - solved.segment<3>(3 * a);
    const auto state = sheet.triangles[e].deform({{{w1[0], w1[1], w1[2]}, {w2[0], w2[1], w2[2]}}});
    CHECK((to_vector(law.stress(state.strain)) - to_vector(expected)).norm() <
          1e-12 * to_vector(expected).norm());
  }
}

}  // namespace

TEST_CASE("a distorted patch of membranes carries a constant stress exactly, isotropic and orthotropic") {
  const PlaneElasticity steel = PlaneElasticity::from(IsotropicSheet{2.1e11, 0.3});
  const PlaneElasticity mesh = PlaneElasticity::from(OrthotropicSheet{4e9, 1e9, 0.2, 3e8});
  check_patch(LinearSheet(steel, {0, 0, 0}));
  check_patch(LinearSheet(mesh, {1e7, 2e7, 0}));
  check_patch(TensionField<ExactWrinkles>(mesh, {1e7, 2e7, 0}));
}

TEST_CASE("a prestressed square relaxes to the stretch where its stress vanishes, on any mesh") {
  // S = E e + S_pre = 0 with e = (q^2 - 1)/2:  q = sqrt(1 - 2 S_pre/E) = sqrt(5/7)
  const double E = 2.1e11, S_pre = 3e10, expected = edge * (std::sqrt(1 - 2 * S_pre / E) - 1);
  CHECK(expected == Approx(-0.185814894325780107).epsilon(1e-14));
  const LinearSheet law(PlaneElasticity::from(IsotropicSheet{E, 0}), {S_pre, 0, 0});
  for (const unsigned seed : {82u, 83u}) {
    const Sheet sheet(seed, Vector3(1, 0, 0));
    const auto is_free = [&](Eigen::Index node, Eigen::Index axis) {
      const Vector3& X = sheet.nodes[static_cast<std::size_t>(node)];
      return (axis == 0 && X[0] != 0) || (axis == 1 && X[1] != 0);
    };
    const Eigen::VectorXd u =
        sheet.solve(law, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(sheet.nodes.size())), is_free);
    for (std::size_t i = 0; i < sheet.nodes.size(); ++i)
      if (sheet.nodes[i][0] == edge)
        CHECK(u[3 * static_cast<Eigen::Index>(i)] == Approx(expected).epsilon(1e-12));
  }
}

namespace {

/// Stress along a strip at an axial strain, free to contract across: the lateral strain where the stress
/// across vanishes.
template <class Law>
double uniaxial_stress(const Law& law, double strain) {
  double low = -10 * std::abs(strain) - 1e-9, high = -low;
  for (int halving = 0; halving < 80; ++halving) {
    const double lateral = 0.5 * (low + high);
    (law.stress(PlaneStrain<double>{strain, lateral, 0}).yy > 0 ? high : low) = lateral;
  }
  return law.stress(PlaneStrain<double>{strain, low, 0}).xx;
}

template <class Law>
void check_strip(const Law& law, double E) {
  const double h = 0.4, t = 1e-4, curvature = 1e-3;  // m, m, 1/m
  for (const double x : {0.3, 0.7, 1.0, 1.5, 3.0, 10.0, 50.0}) {
    const double P = E * t * h * h * curvature / (2 * x);  // N
    constexpr int fibres = 4000;
    const auto resultants = [&](double middle_strain) {
      Eigen::Vector2d sum(0, 0);
      for (int k = 0; k < fibres; ++k) {
        const double y = h * ((k + 0.5) / fibres - 0.5);
        const double force = t * h / fibres * uniaxial_stress(law, middle_strain + curvature * y);
        sum += Eigen::Vector2d(force, force * y);
      }
      return sum;
    };
    double low = -curvature * h, high = P / (E * t * h) + curvature * h;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (resultants(middle)[0] > P ? high : low) = middle;
    }
    const double M = resultants(0.5 * (low + high))[1];
    const double expected = x <= 1 ? x / 3 : 1 - 2 / (3 * std::sqrt(x));
    CHECK(2 * M / (P * h) ==
          Approx(expected).margin(2e-4));  // fibres of h/4000, the wrinkled band ends inside one
    if (x > 1) {
      const double band = (-0.5 * (low + high) / curvature + 0.5 * h) / h;  // up to where the strain vanishes
      CHECK(band == Approx(3 * M / (P * h) - 0.5).margin(1e-3));
    }
  }
}

}  // namespace

TEST_CASE(
    "a pulled strip in bending follows Stein and Hedgepeth: stiffness falls once its edge has wrinkled") {
  const double E = 3e9;
  const PlaneElasticity foil = PlaneElasticity::from(IsotropicSheet{E, 0.3});
  check_strip(TensionField<ExactWrinkles>(foil, {0, 0, 0}), E);
  check_strip(TensionField<PrincipalWrinkles>(foil, {0, 0, 0}), E);
}
