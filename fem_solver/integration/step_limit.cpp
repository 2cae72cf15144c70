#include "fem_solver/integration/step_limit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

using Vector = Eigen::VectorXd;

/// 1/sqrt(m) of every direction, 0 where it is supported or nothing is to be moved.
Vector free_inverse_root_mass(const Model& model) {
  Vector scale(static_cast<Eigen::Index>(model.reference.size()));
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const double mass = model.node_masses[static_cast<std::size_t>(i / 3)];
    scale[i] = mass > 0 ? 1 / std::sqrt(mass) : 0;
  }
  for (const auto& support : model.supports)
    for (const Index node : support.nodes)
      for (int c = 0; c < 3; ++c)
        if (support.fixed[static_cast<std::size_t>(c)]) scale[3 * node + c] = 0;
  return scale;
}

Vector start_vector(const Vector& scale) {
  std::mt19937_64 random(20240229);
  Vector q(scale.size());
  for (auto& value : q) value = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
  q = (scale.array() > 0).select(q, 0.0);
  return q;
}

/// Largest eigenvalue of the tridiagonal matrix, plus the residual of its vector. Scaled to 1, because the
/// eigenvalue iteration compares small entries with absolute thresholds.
double upper_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside,
                        double next_beside) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  const double scale = Vector::Map(diagonal.data(), n).cwiseAbs().maxCoeff();
  if (scale == 0) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Vector::Map(diagonal.data(), n) / scale,
                                Vector::Map(beside.data(), n - 1) / scale);
  if (solver.info() != Eigen::Success)
    throw core::NumericalError({.what = "the highest frequency of the structure could not be computed",
                                .entity = "number of Lanczos vectors",
                                .value = static_cast<double>(n)});
  return scale * solver.eigenvalues()[n - 1] + std::abs(next_beside * solver.eigenvectors()(n - 1, n - 1));
}

}  // namespace

double largest_frequency(Assembly& assembly, std::span<const double> displacement) {
  constexpr std::size_t most_products = 80;
  const Vector scale = free_inverse_root_mass(assembly.model());
  Vector q = start_vector(scale), before = Vector::Zero(q.size()), x(q.size()), r(q.size());
  if (q.norm() == 0) return 0;
  q.normalize();
  std::vector<double> diagonal, beside;
  double beta = 0;
  while (true) {
    x = scale.cwiseProduct(q);
    assembly.stiffest_product(displacement, {x.data(), static_cast<std::size_t>(x.size())},
                              {r.data(), static_cast<std::size_t>(r.size())});
    r = r.cwiseProduct(scale) - beta * before;
    diagonal.push_back(r.dot(q));
    r -= diagonal.back() * q;
    beta = r.norm();
    const double largest =
        std::abs(*std::ranges::max_element(diagonal, {}, [](double d) { return std::abs(d); }));
    if (diagonal.size() == most_products || beta <= 1e-10 * largest)
      return std::sqrt(std::max(0.0, upper_eigenvalue(diagonal, beside, beta)));
    beside.push_back(beta);
    before = q;
    q = r / beta;
  }
}

double stable_step(double frequency, const Damping& damping) {
  if (frequency == 0) return std::numeric_limits<double>::infinity();
  const double xi = 0.5 * damping.stiffness * frequency;
  return 2 / frequency * (std::sqrt(1 + xi * xi) - xi);
}

namespace {

struct ElementBound {
  double seconds = std::numeric_limits<double>::infinity();
  Index element = 0;
};

/// dt = L sqrt(rho/modulus), the time a wave takes along the shortest element: an element alone with its own
/// lumped mass.
template <class Compression, class Modulus>
ElementBound shortest_passage(const TwoNodeBatch<Compression>& batch, const Modulus& modulus) {
  ElementBound shortest;
  for (Index e = 0; e < batch.size(); ++e) {
    const double stiffness = modulus(e);
    if (stiffness <= 0) continue;
    const double seconds = batch.reference_length(e) * std::sqrt(batch.part().density / stiffness);
    if (seconds < shortest.seconds) shortest = {seconds, e};
  }
  return shortest;
}

template <class Compression>
void add_part_bounds(const Part& part, const TwoNodeBatch<Compression>& batch,
                     std::span<const double> displacement, const Damping& damping,
                     std::vector<StepBound>& bounds) {
  const auto add = [&](const char* name, const char* formula, const ElementBound& bound) {
    if (!std::isfinite(bound.seconds)) return;
    bounds.push_back({fmt::format("{} {}", name, part.name), stable_step(2 / bound.seconds, damping),
                      fmt::format("{}; element {} of {}, L = {:.4g} m", formula, bound.element, part.name,
                                  batch.reference_length(bound.element))});
  };
  add("wave along", "L sqrt(density/(E (1 + 2 e) + S))",
      shortest_passage(batch, [&](Index e) { return batch.wave_moduli(displacement, e).along; }));
  add("string wave across", "L sqrt(density/S)",
      shortest_passage(batch, [&](Index e) { return batch.wave_moduli(displacement, e).across; }));
}

/// Other elements have no closed form: the highest frequency of the structure stands for them.
template <class Batch>
void add_part_bounds(const Part&, const Batch&, std::span<const double>, const Damping&,
                     std::vector<StepBound>&) {}

}  // namespace

std::vector<StepBound> step_bounds(Assembly& assembly, std::span<const double> displacement) {
  const Model& model = assembly.model();
  std::vector<StepBound> bounds;
  for (const auto& part : model.parts)
    std::visit([&](const auto& batch) { add_part_bounds(part, batch, displacement, model.damping, bounds); },
               part.elements);
  std::ranges::stable_sort(bounds, {}, &StepBound::seconds);
  const double frequency = largest_frequency(assembly, displacement);
  if (frequency == 0) return bounds;
  const std::string tightest = bounds.empty() ? ""
                                              : fmt::format("; its tightest elements: {}, {}",
                                                            bounds.front().name, bounds.front().reason);
  bounds.insert(
      bounds.begin(),
      {"highest frequency of the structure", stable_step(frequency, model.damping),
       fmt::format(
           "(2/w)(sqrt(1 + xi^2) - xi) with w = {:.6g} 1/s, xi = {:.3g}, from the stiffness of the taut "
           "structure with its geometric part{}",
           frequency, 0.5 * model.damping.stiffness * frequency, tightest)});
  return bounds;
}

}  // namespace talus::fem
