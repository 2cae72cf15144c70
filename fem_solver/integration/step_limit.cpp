#include "fem_solver/integration/step_limit.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "fem_solver/constraints/held_directions.hpp"

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
  for (const HeldDirection& h : held_directions(model)) scale[static_cast<Eigen::Index>(h.direction)] = 0;
  return scale;
}

Vector start_vector(const Vector& scale) {
  std::mt19937_64 random(20240229);
  Vector q(scale.size());
  for (auto& value : q) value = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
  q = (scale.array() > 0).select(q, 0.0);
  return q;
}

/// The tridiagonal matrix that the iteration makes, and what is left beside its last entry.
struct Tridiagonal {
  std::vector<double> diagonal, beside;
  double next_beside = 0;
};

/// The largest eigenvalue and its vector.
struct Upper {
  double value = 0;
  Vector vector = {};
};

/// Scaled to 1, because the eigenvalue iteration compares small entries with absolute thresholds.
Upper upper_of(const Tridiagonal& made) {
  const auto n = static_cast<Eigen::Index>(made.diagonal.size());
  const double scale = Vector::Map(made.diagonal.data(), n).cwiseAbs().maxCoeff();
  if (scale == 0) return {.value = 0, .vector = Vector::Zero(n)};
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Vector::Map(made.diagonal.data(), n) / scale,
                                Vector::Map(made.beside.data(), n - 1) / scale);
  if (solver.info() != Eigen::Success)
    throw core::NumericalError({.what = "the highest frequency of the structure could not be computed",
                                .entity = "number of Lanczos vectors",
                                .value = static_cast<double>(n)});
  return {.value = scale * solver.eigenvalues()[n - 1], .vector = solver.eigenvectors().col(n - 1)};
}

/// Lanczos iteration from the fixed start vector; visit(q) sees every vector of the basis.
template <class Visit>
Tridiagonal iterate(Assembly& assembly, const Configuration& at, const Vector& scale, Visit&& visit) {
  constexpr std::size_t most_products = 80;
  Tridiagonal made;
  Vector q = start_vector(scale), before = Vector::Zero(q.size()), x(q.size()), r(q.size());
  if (q.norm() == 0) return made;
  q.normalize();
  while (true) {
    visit(q);
    x = scale.cwiseProduct(q);
    assembly.stiffest_product(at, {x.data(), static_cast<std::size_t>(x.size())},
                              {r.data(), static_cast<std::size_t>(r.size())});
    r = r.cwiseProduct(scale) - made.next_beside * before;
    made.diagonal.push_back(r.dot(q));
    r -= made.diagonal.back() * q;
    made.next_beside = r.norm();
    const double largest =
        std::abs(*std::ranges::max_element(made.diagonal, {}, [](double d) { return std::abs(d); }));
    if (made.diagonal.size() == most_products || made.next_beside <= 1e-10 * largest) return made;
    made.beside.push_back(made.next_beside);
    before = q;
    q = r / made.next_beside;
  }
}

/// The displacement of the fastest mode, of any size. The basis is made a second time, not kept.
Vector fastest_shape(Assembly& assembly, const Configuration& at) {
  const Vector scale = free_inverse_root_mass(assembly.model());
  const Tridiagonal made = iterate(assembly, at, scale, [](const Vector&) {});
  Vector shape = Vector::Zero(scale.size());
  if (made.diagonal.empty()) return shape;
  const Upper upper = upper_of(made);
  Eigen::Index k = 0;
  iterate(assembly, at, scale, [&](const Vector& q) { shape += upper.vector[k++] * q; });
  return scale.cwiseProduct(shape);
}

}  // namespace

double largest_frequency(Assembly& assembly, const Configuration& at) {
  const Tridiagonal made =
      iterate(assembly, at, free_inverse_root_mass(assembly.model()), [](const Vector&) {});
  if (made.diagonal.empty()) return 0;
  const Upper upper = upper_of(made);
  const double residual = std::abs(made.next_beside * upper.vector[upper.vector.size() - 1]);
  return std::sqrt(std::max(0.0, upper.value + residual));
}

double stable_step(double frequency, double damping) {
  if (frequency == 0) return std::numeric_limits<double>::infinity();
  const double xi = 0.5 * damping * frequency;
  return 2 / frequency * (std::sqrt(1 + xi * xi) - xi);
}

namespace {

std::string formula(double frequency, double damping) {
  return fmt::format("(2/w)(sqrt(1 + xi^2) - xi) with w = {:.6g} 1/s, xi = {:.3g}", frequency,
                     0.5 * damping * frequency);
}

/// A part that can hang slack, and does.
template <class Batch>
constexpr bool may_be_slack =
    std::is_same_v<Batch, CableBatch> || std::is_same_v<Batch, SlidingCableBatch> ||
    std::is_same_v<Batch, FrictionalCableBatch> || std::is_same_v<Batch, ElasticPlasticBatch> ||
    std::is_same_v<Batch, PlainRingBatch> || Breaks<Batch>;
template <class Batch>
bool is_slack(const Batch& batch, const Configuration& at) {
  if constexpr (!may_be_slack<Batch>)
    return false;
  else if constexpr (requires { batch.axial_force(at, 0); })
    return batch.size() > 0 && batch.axial_force(at, 0) <= 0;
  else if constexpr (requires { batch.tension(at); })
    return batch.tension(at) <= 0;
  else
    return batch.tension(at, 0) <= 0;
}

/// What snaps taut keeps the balance of energy to about half a percent at this share of the limit (docs/step_limits.md).
constexpr double share_for_snapping = 0.25;

/// The bounds of one structure at one state.
class BoundSearch {
 public:
  BoundSearch(Assembly& assembly, const Configuration& at)
      : assembly_(assembly),
        model_(assembly.model()),
        at_(at),
        part_(at),
        whole_(largest_frequency(assembly, at)) {}

  std::vector<StepBound> run() {
    if (whole_ == 0) return {};
    shape_ = fastest_shape(assembly_, at_);
    for_each_part(model_, at_, [&](std::size_t p, const auto& batch, const Configuration& own) {
      const std::string& name = model_.parts[p].name;
      part_ = own;
      weigh(name, batch.called(), batch);
      slack_ = slack_ || is_slack(batch, own);
      add_part(name, batch);
    });
    std::ranges::stable_sort(bounds_, {}, &StepBound::seconds);
    const double seconds = stable_step(whole_, largest_stiffness_damping(model_));
    bounds_.insert(bounds_.begin(),
                   {"highest frequency of the structure", seconds,
                    formula(whole_, largest_stiffness_damping(model_)) +
                        ", from the stiffness of the taut structure with its geometric part" + seat_ +
                        snapping(seconds)});
    return std::move(bounds_);
  }

 private:
  /// Where the fastest mode lives: the part that takes most of its energy, and the node where most of that is.
  void weigh(const std::string& name, const std::string& kind, ElementBatch elements) {
    Model alone = only(std::move(elements));
    Assembly assembly(alone);
    Vector product(shape_.size());
    assembly.stiffest_product(part_, {shape_.data(), static_cast<std::size_t>(shape_.size())},
                              {product.data(), static_cast<std::size_t>(product.size())});
    const double energy = shape_.dot(product);
    if (energy <= seat_energy_) return;
    seat_energy_ = energy;
    Eigen::Index node = 0;
    double most = -1;
    for (Eigen::Index i = 0; i < shape_.size(); i += 3)
      if (const double here = shape_.segment<3>(i).dot(product.segment<3>(i)); here > most)
        most = here, node = i / 3;
    seat_ = fmt::format("; set by the {} of {}, most of all at {}", kind, name,
                        fem::node_name(model_, static_cast<Index>(node)));
  }
  /// For the reader of the first bound.
  std::string snapping(double seconds) const {
    if (!slack_) return "";
    return fmt::format(
        "; ropes that hang slack will snap taut: for their balance of energy take a quarter of it, {}",
        core::readable(share_for_snapping * seconds, "s"));
  }

  template <class Batch>
  void add_part(const std::string& name, const Batch& batch) {
    if (model_.parts.size() > 1)
      add(fmt::format("{} of {} alone", Batch::called(), name), frequency_of(batch), "");
  }
  template <class Compression>
  void add_part(const std::string& name, const TwoNodeBatch<Compression>& batch) {
    const std::string element = shortest_element(name, batch);
    if (model_.parts.size() > 1)
      add(fmt::format("{} of {} alone", batch.called(), name), frequency_of(batch), element);
    if (batch.part().section.prestress <= 0) return;
    AxialPart string = batch.part();
    string.section.youngs_modulus = 0;
    add(fmt::format("geometric stiffness of {} alone", name),
        frequency_of(TwoNodeBatch<Compression>(string, batch.cells(), model_.reference)),
        fmt::format("; sqrt(S/density) = {:.4g} m/s", std::sqrt(string.section.prestress / string.density)));
  }

  /// Of the structure's masses on these elements alone; never above the whole structure's, but for round-off.
  double frequency_of(ElementBatch elements) const {
    const Model alone = only(std::move(elements));
    Assembly assembly(alone);
    return std::min(whole_, largest_frequency(assembly, part_));
  }
  Model only(ElementBatch elements) const {
    Model alone = model_;
    alone.parts.clear();
    alone.parts.push_back({"alone", std::move(elements), {}});
    return alone;
  }
  void add(const std::string& name, double frequency, const std::string& more) {
    if (frequency > 0)
      bounds_.push_back({name, stable_step(frequency, largest_stiffness_damping(model_)),
                         formula(frequency, largest_stiffness_damping(model_)) + more});
  }

  /// The element that a wave passes in the shortest time, L sqrt(density/(E (1 + 2 e) + S)).
  template <class Compression>
  std::string shortest_element(const std::string& name, const TwoNodeBatch<Compression>& batch) {
    Index shortest = -1;
    double seconds = std::numeric_limits<double>::infinity();
    for (Index e = 0; e < batch.size(); ++e) {
      const double passage =
          batch.reference_length(e) * std::sqrt(batch.part().density / batch.wave_moduli(part_, e).along);
      if (passage < seconds) seconds = passage, shortest = e;
    }
    if (shortest < 0) return "";
    return fmt::format("; its shortest element is {} of {}, L = {:.4g} m, which a wave passes in {:.4g} s",
                       shortest, name, batch.reference_length(shortest), seconds);
  }

  Assembly& assembly_;
  const Model& model_;
  Configuration at_;
  Configuration part_;  ///< of the part in turn
  double whole_;
  Vector shape_;            ///< of the fastest mode
  double seat_energy_ = 0;  ///< of the part that takes most of its energy, in the mode's units
  std::string seat_;
  bool slack_ = false;  ///< some rope hangs slack
  std::vector<StepBound> bounds_;
};

}  // namespace

std::vector<StepBound> step_bounds(Assembly& assembly, const Configuration& at) {
  return BoundSearch(assembly, at).run();
}

}  // namespace talus::fem
