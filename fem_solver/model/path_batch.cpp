#include "fem_solver/model/path_batch.hpp"

#include <algorithm>
#include <utility>

namespace talus::fem {

template <class Law>
PathBatch<Law>::PathBatch(Description description, std::vector<std::array<Index, 2>> segments,
                          std::span<const double> reference)
    : description_(std::move(description)), segments_(std::move(segments)) {
  for (Index e = 0; e < size(); ++e) {
    const Vector3 span = difference(reference, e);
    reference_.insert(reference_.end(), span.begin(), span.end());
    lengths_.push_back(span.norm());
  }
}

template <class Law>
void PathBatch<Law>::internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                                    core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e) {
    const Vector3 d = chord(at.displacement, e);
    const AxialResponse response = segment(e).respond(d, kept(at, e));
    next[place(e)] = response.history;
    Vector3::Map(&slots[3 * place(e)]) = segment(e).force(d, response);
  }
}

template <class Law>
void PathBatch<Law>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                       std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e) {
    const Vector3 d = chord(at.displacement, e);
    Vector3::Map(&slots[3 * place(e)]) =
        segment(e).stiffness(d, segment(e).respond(d, kept(at, e))) * difference(direction, e);
  }
}

template <class Law>
Matrix3 PathBatch<Law>::material_stiffness(const Configuration& at, Index e) const noexcept {
  const Vector3 d = chord(at.displacement, e);
  const AxialResponse response = segment(e).respond(d, kept(at, e));
  return segment(e).stiffness(
      d, {.force = 0, .slope = std::max(0.0, response.slope), .history = response.history});
}

template <class Law>
void PathBatch<Law>::damping_product(const Configuration& at, std::span<const double> velocity,
                                     std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) = material_stiffness(at, e) * difference(velocity, e);
}

template <class Law>
Matrix3 PathBatch<Law>::stiffest(const Configuration& at, Index e) const noexcept {
  if constexpr (requires { Law::is_broken(0.0); })
    if (is_broken(at, e)) return Matrix3::Zero();
  const Vector3 d = chord(at.displacement, e);
  AxialResponse response = segment(e).respond(d, kept(at, e));
  response.slope = description_.law.stiffest_slope({d.norm(), lengths_[place(e)]}, response.force);
  return segment(e).stiffness(d, response);
}

template <class Law>
void PathBatch<Law>::stiffest_product(const Configuration& at, std::span<const double> direction,
                                      std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e) {
    Vector3::Map(&slots[3 * place(e)]) = stiffest(at, e) * difference(direction, e);
  }
}

template <class Law>
void PathBatch<Law>::add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept {
  for (Index e = 0; e < size(); ++e) {
    add_pair_bound(segments_[place(e)], stiffest(at, e), row_sums);
  }
}

template <class Law>
double PathBatch<Law>::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += segment(e).stored(chord(at.displacement, e), kept(at, e));
  return sum;
}

template <class Law>
double PathBatch<Law>::dissipated(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += segment(e).dissipated(chord(at.displacement, e), kept(at, e));
  return sum;
}

template <class Law>
void PathBatch<Law>::add_mass(std::span<double> node_masses) const noexcept {
  for (Index e = 0; e < size(); ++e)
    for (const Index node : segments_[place(e)])
      node_masses[place(node)] += 0.5 * description_.mass_per_length * lengths_[place(e)];
}

template class PathBatch<BrakeLaw>;
template class PathBatch<ElasticPlasticRope>;
template class PathBatch<Breaking<ElasticRope>>;
template class PathBatch<Breaking<ElasticPlasticRope>>;
template class PathBatch<Breaking<BrakeLaw>>;

}  // namespace talus::fem
