#include "fem_solver/model/two_node_batch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::fem {

template <class Compression>
TwoNodeBatch<Compression>::TwoNodeBatch(const AxialPart& part, std::vector<std::array<Index, 2>> segments,
                                        std::span<const double> reference)
    : part_(part), segments_(std::move(segments)) {
  reference_.resize(3 * segments_.size());
  inverse_length_.resize(segments_.size());
  for (Index e = 0; e < size(); ++e) {
    const Vector3 span = difference(reference, e);
    Vector3::Map(&reference_[3 * place(e)]) = span;
    inverse_length_[place(e)] = 1 / span.norm();
  }
}

template <class Compression>
void TwoNodeBatch<Compression>::internal_force(const Configuration& at, std::span<double> slots,
                                               core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) = element(e).force(difference(at.displacement, e));
}

template <class Compression>
void TwoNodeBatch<Compression>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                                  std::span<double> slots,
                                                  core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) =
        element(e).stiffness_product(difference(at.displacement, e), difference(direction, e));
}

template <class Compression>
void TwoNodeBatch<Compression>::stiffest_product(const Configuration& at, std::span<const double> direction,
                                                 std::span<double> slots,
                                                 core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) =
        element(e).stiffest_product(difference(at.displacement, e), difference(direction, e));
}

template <class Compression>
void TwoNodeBatch<Compression>::damping_product(const Configuration& at, std::span<const double> velocity,
                                                std::span<double> slots,
                                                core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) =
        element(e).material_product(difference(at.displacement, e), difference(velocity, e));
}

template <class Compression>
void TwoNodeBatch<Compression>::add_stiffness_bound(const Configuration& at,
                                                    std::span<double> row_sums) const noexcept {
  for (Index e = 0; e < size(); ++e) {
    const AxialElement<Compression> bar = element(e);
    const Vector3 stretch = difference(at.displacement, e), d = bar.reference + stretch;
    const double S = Compression::stress(bar.trial_stress(bar.strain(stretch))), inverse = bar.inverse_length;
    add_pair_bound(
        segments_[place(e)],
        bar.section.area * inverse *
            (bar.section.youngs_modulus * inverse * inverse * d * d.transpose() + S * Matrix3::Identity()),
        row_sums);
  }
}

template <class Compression>
double TwoNodeBatch<Compression>::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += element(e).energy(difference(at.displacement, e));
  return sum;
}

template <class Compression>
void TwoNodeBatch<Compression>::add_mass(std::span<double> node_masses) const noexcept {
  for (Index e = 0; e < size(); ++e) {
    const double half = 0.5 * part_.density * part_.section.area / inverse_length_[place(e)];
    node_masses[place(segments_[place(e)][0])] += half;
    node_masses[place(segments_[place(e)][1])] += half;
  }
}

template class TwoNodeBatch<CarriesCompression>;
template class TwoNodeBatch<TensionOnly>;

}  // namespace talus::fem
