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

/// What limits a part's step, in words.
template <class Batch>
constexpr const char* kind_of = "elements";
template <>
constexpr const char* kind_of<BarBatch> = "bars";
template <>
constexpr const char* kind_of<CableBatch> = "cables";
template <>
constexpr const char* kind_of<SlidingCableBatch> = "sliding rope";
template <>
constexpr const char* kind_of<FrictionalCableBatch> = "sliding rope";
template <>
constexpr const char* kind_of<PenaltySlideBatch> = "penalty springs";
template <class Law>
constexpr const char* kind_of<MembraneBatch<Law>> = "membrane";
template <>
constexpr const char* kind_of<BrakeBatch> = "brakes";

std::string formula(double frequency, const Damping& damping) {
  return fmt::format("(2/w)(sqrt(1 + xi^2) - xi) with w = {:.6g} 1/s, xi = {:.3g}", frequency,
                     0.5 * damping.stiffness * frequency);
}

/// The bounds of one structure at one state.
class BoundSearch {
 public:
  BoundSearch(Assembly& assembly, std::span<const double> displacement)
      : model_(assembly.model()),
        displacement_(displacement),
        whole_(largest_frequency(assembly, displacement)) {}

  std::vector<StepBound> run() {
    if (whole_ == 0) return {};
    for (const auto& part : model_.parts)
      std::visit([&](const auto& batch) { add_part(part.name, batch); }, part.elements);
    std::ranges::stable_sort(bounds_, {}, &StepBound::seconds);
    bounds_.insert(bounds_.begin(),
                   {"highest frequency of the structure", stable_step(whole_, model_.damping),
                    formula(whole_, model_.damping) +
                        ", from the stiffness of the taut structure with its geometric part" + tightest_});
    return std::move(bounds_);
  }

 private:
  template <class Batch>
  void add_part(const std::string& name, const Batch& batch) {
    if (model_.parts.size() > 1)
      add(fmt::format("{} of {} alone", kind_of<Batch>, name), frequency_of(batch), "");
  }
  template <class Compression>
  void add_part(const std::string& name, const TwoNodeBatch<Compression>& batch) {
    const std::string element = shortest_element(name, batch);
    if (model_.parts.size() > 1)
      add(fmt::format("{} of {} alone", kind_of<TwoNodeBatch<Compression>>, name), frequency_of(batch),
          element);
    if (batch.part().section.prestress <= 0) return;
    AxialPart string = batch.part();
    string.section.youngs_modulus = 0;
    add(fmt::format("geometric stiffness of {} alone", name),
        frequency_of(TwoNodeBatch<Compression>(string, batch.cells(), model_.reference)),
        fmt::format("; sqrt(S/density) = {:.4g} m/s", std::sqrt(string.section.prestress / string.density)));
  }

  /// Of the structure's masses on these elements alone; never above the whole structure's, but for round-off.
  double frequency_of(ElementBatch elements) const {
    Model alone = model_;
    alone.parts.clear();
    alone.parts.push_back({"alone", std::move(elements), {}});
    Assembly assembly(alone);
    return std::min(whole_, largest_frequency(assembly, displacement_));
  }
  void add(const std::string& name, double frequency, const std::string& more) {
    if (frequency > 0)
      bounds_.push_back(
          {name, stable_step(frequency, model_.damping), formula(frequency, model_.damping) + more});
  }

  /// The element that a wave passes in the shortest time, L sqrt(density/(E (1 + 2 e) + S)).
  template <class Compression>
  std::string shortest_element(const std::string& name, const TwoNodeBatch<Compression>& batch) {
    Index shortest = -1;
    double seconds = std::numeric_limits<double>::infinity();
    for (Index e = 0; e < batch.size(); ++e) {
      const double passage = batch.reference_length(e) *
                             std::sqrt(batch.part().density / batch.wave_moduli(displacement_, e).along);
      if (passage < seconds) seconds = passage, shortest = e;
    }
    if (shortest < 0) return "";
    const std::string element =
        fmt::format("; its shortest element is {} of {}, L = {:.4g} m, which a wave passes in {:.4g} s",
                    shortest, name, batch.reference_length(shortest), seconds);
    if (seconds < shortest_passage_) {
      shortest_passage_ = seconds;
      tightest_ = element;
    }
    return element;
  }

  const Model& model_;
  std::span<const double> displacement_;
  double whole_;
  double shortest_passage_ = std::numeric_limits<double>::infinity();
  std::string tightest_;
  std::vector<StepBound> bounds_;
};

}  // namespace

std::vector<StepBound> step_bounds(Assembly& assembly, std::span<const double> displacement) {
  return BoundSearch(assembly, displacement).run();
}

}  // namespace talus::fem
