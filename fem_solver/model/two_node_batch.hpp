#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/axial.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/index.hpp"
#include "fem_solver/model/pair_incidence.hpp"

namespace talus::fem {

/// What a part needs to know of its material besides the elastic law.
struct AxialPart {
  AxialSection section;
  double density = 0;  ///< kg/m^3
};

/// All two-node elements of a part, as arrays. One force slot an element: the far node's force, which the
/// near one feels negated.
/// @see ElementBatch for the meaning of the members.
template <class Compression>
class TwoNodeBatch {
 public:
  /// @param reference node positions, 3 a node (m)
  /// @pre every segment joins two nodes at different places
  TwoNodeBatch(const AxialPart& part, std::vector<std::array<Index, 2>> segments,
               std::span<const double> reference);

  static std::string called() { return Compression::called; }
  Index size() const { return static_cast<Index>(segments_.size()); }
  Index slots() const { return size(); }
  const std::vector<std::array<Index, 2>>& cells() const { return segments_; }

  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for_each_pair_incidence(segments_, visit);
  }

  void internal_force(const Configuration& at, std::span<double> slots, core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block elements) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept;
  double energy(const Configuration& at) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept;

  /// sink(row node, column node, 3x3 block), the same blocks in the same order whatever the state.
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) {
      const Matrix3 K = element(e).stiffness(difference(at.displacement, e));
      spread_pair_block(segments_[place(e)], segments_[place(e)], K, sink);
    }
  }

  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e)
      spread_pair_block(segments_[place(e)], segments_[place(e)],
                        element(e).material_stiffness(difference(at.displacement, e)), sink);
  }

  double axial_force(const Configuration& at, Index e) const noexcept {
    return element(e).axial_force(difference(at.displacement, e));
  }
  /// Second Piola-Kirchhoff stress (Pa).
  double stress(const Configuration& at, Index e) const noexcept {
    const AxialElement<Compression> bar = element(e);
    return Compression::stress(bar.trial_stress(bar.strain(difference(at.displacement, e))));
  }
  /// Moduli that carry waves along and across an element (Pa, per reference area); along as if a cable were
  /// taut.
  struct WaveModuli {
    double along, across;
  };
  WaveModuli wave_moduli(const Configuration& at, Index e) const noexcept {
    const AxialElement<Compression> bar = element(e);
    const double strain = bar.strain(difference(at.displacement, e)), trial = bar.trial_stress(strain);
    const double stress = Compression::stress(trial);
    return {part_.section.youngs_modulus * (1 + 2 * strain) + stress, stress};
  }
  double reference_length(Index e) const noexcept { return 1 / inverse_length_[place(e)]; }
  const AxialPart& part() const { return part_; }
  AxialElement<Compression> element(Index e) const noexcept {
    return {Vector3::Map(&reference_[3 * place(e)]), inverse_length_[place(e)], part_.section};
  }

 private:
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  Vector3 difference(std::span<const double> values, Index e) const noexcept {
    const auto [near, far] = segments_[place(e)];
    return Vector3::Map(&values[3 * place(far)]) - Vector3::Map(&values[3 * place(near)]);
  }

  AxialPart part_;
  std::vector<std::array<Index, 2>> segments_;
  std::vector<double> reference_;       ///< m; near to far node, 3 an element
  std::vector<double> inverse_length_;  ///< 1/m
};

using BarBatch = TwoNodeBatch<CarriesCompression>;
using CableBatch = TwoNodeBatch<TensionOnly>;
extern template class TwoNodeBatch<CarriesCompression>;
extern template class TwoNodeBatch<TensionOnly>;

}  // namespace talus::fem
