#include "fem_solver/homogenise/periodic_net.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

#include "core/errors.hpp"

namespace talus::fem {

using core::Vector3;

namespace {

constexpr int most_iterations = 500;
/// Out-of-balance force at a node, relative to the largest axial stiffness EA, at which it is in equilibrium.
constexpr double in_equilibrium = 1e-12;

AxialElement<TensionOnly> element(const PeriodicNet::Wire& wire) {
  return {wire.reference, 1 / wire.reference.norm(), wire.section};
}

/// Where a node's fluctuation stands among the unknowns; negative for the first node.
Eigen::Index place(int node) {
  return 2 * (static_cast<Eigen::Index>(node) - 1);
}

Vector3 in_plane(const Eigen::Vector2d& v) {
  return {v.x(), v.y(), 0};
}

}  // namespace

double PeriodicNet::mass_per_area() const {
  double mass = 0;
  for (const auto& wire : wires) mass += wire.density * wire.section.area * wire.reference.norm();
  return mass / area;
}

NetResponse::NetResponse(const PeriodicNet& net)
    : net_(net), fluctuations_(Eigen::VectorXd::Zero(2 * (net.nodes - 1))) {}

Vector3 NetResponse::change(const PeriodicNet::Wire& wire, const Eigen::VectorXd& fluctuations) const {
  const Eigen::Vector2d D = wire.reference.head<2>();
  Eigen::Vector2d change = stretch_ * D - D;
  if (wire.far > 0) change += fluctuations.segment<2>(place(wire.far));
  if (wire.near > 0) change -= fluctuations.segment<2>(place(wire.near));
  return in_plane(change);
}

double NetResponse::energy(const Eigen::VectorXd& fluctuations) const {
  double sum = 0;
  for (const auto& wire : net_.wires) sum += element(wire).energy(change(wire, fluctuations));
  return sum;
}

Eigen::VectorXd NetResponse::gradient(const Eigen::VectorXd& fluctuations) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(fluctuations.size());
  for (const auto& wire : net_.wires) {
    const Eigen::Vector2d force = element(wire).force(change(wire, fluctuations)).head<2>();
    if (wire.far > 0) sum.segment<2>(place(wire.far)) += force;
    if (wire.near > 0) sum.segment<2>(place(wire.near)) -= force;
  }
  return sum;
}

Eigen::MatrixXd NetResponse::hessian(const Eigen::VectorXd& fluctuations) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(fluctuations.size(), fluctuations.size());
  for (const auto& wire : net_.wires) {
    const Eigen::Matrix2d block = element(wire).stiffness(change(wire, fluctuations)).topLeftCorner<2, 2>();
    const auto add = [&](int row, int column, double sign) {
      if (row > 0 && column > 0) sum.block<2, 2>(place(row), place(column)) += sign * block;
    };
    add(wire.far, wire.far, 1);
    add(wire.near, wire.near, 1);
    add(wire.far, wire.near, -1);
    add(wire.near, wire.far, -1);
  }
  return sum;
}

void NetResponse::stretch_to(const PlaneStrain<double>& strain) {
  Eigen::Matrix2d right_cauchy_green;
  right_cauchy_green << 1 + 2 * strain.xx, strain.shear, strain.shear, 1 + 2 * strain.yy;
  stretch_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(right_cauchy_green).operatorSqrt();

  double largest_stiffness = 0;
  for (const auto& wire : net_.wires)
    largest_stiffness = std::max(largest_stiffness, wire.section.area * wire.section.youngs_modulus);
  // Newton's method with Levenberg's damping: loose parts of the net have no stiffness of their own.
  double damping = 1e-9;
  double present = energy(fluctuations_);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Eigen::VectorXd out_of_balance = gradient(fluctuations_);
    if (out_of_balance.size() == 0 ||
        out_of_balance.lpNorm<Eigen::Infinity>() <= in_equilibrium * largest_stiffness)
      return;
    Eigen::MatrixXd matrix = hessian(fluctuations_);
    matrix.diagonal().array() += damping * matrix.diagonal().maxCoeff();
    const Eigen::VectorXd trial = fluctuations_ - matrix.ldlt().solve(out_of_balance);
    const double lower = energy(trial);
    // Equal energies near the minimum are round-off.
    if (lower <= present + 1e-15 * std::abs(present)) {
      fluctuations_ = trial;
      present = lower;
      damping = std::max(damping / 10, 1e-12);
    } else {
      damping *= 10;
    }
  }
  throw core::NumericalError({.what = "a cell of the net finds no equilibrium",
                              .entity = "the net to be homogenised",
                              .value = gradient(fluctuations_).lpNorm<Eigen::Infinity>()});
}

double NetResponse::energy_per_area() const {
  return energy_per_area(fluctuations_);
}

double NetResponse::energy_per_area(const Eigen::VectorXd& fluctuations) const {
  return energy(fluctuations) / net_.area;
}

PlaneStress<double> NetResponse::membrane_force() const {
  Eigen::Matrix2d first = Eigen::Matrix2d::Zero();
  for (const auto& wire : net_.wires) {
    const Eigen::Vector2d force = element(wire).force(change(wire, fluctuations_)).head<2>();
    first += force * wire.reference.head<2>().transpose() / net_.area;
  }
  const Eigen::Matrix2d second = stretch_.inverse() * first;
  return {second(0, 0), second(1, 1), (second(0, 1) + second(1, 0)) / 2};
}

}  // namespace talus::fem
