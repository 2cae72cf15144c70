#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/membrane.hpp"
#include "fem_solver/materials/exact_wrinkles.hpp"
#include "fem_solver/materials/principal_wrinkles.hpp"
#include "fem_solver/materials/tension_field.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// What a membrane part needs to know besides its law.
struct MembranePart {
  double thickness = 0;                  ///< m
  double density = 0;                    ///< kg/m^3
  std::optional<Vector3> material_axis;  ///< projected on every triangle; without one its first edge
};

/// All triangles of a part, in packs that are computed side by side. Two force slots a triangle: the forces
/// of its second and third node, both of which the first one feels negated.
/// @see ElementBatch for the meaning of the members.
template <class Law>
class MembraneBatch {
 public:
  /// @param reference node positions, 3 a node (m)
  /// @throws core::ConfigError for triangles without area or with an upright material axis
  MembraneBatch(const MembranePart& part, const Law& law, std::vector<std::array<Index, 3>> triangles,
                std::span<const double> reference);

  static std::string called() { return "membrane"; }
  Index size() const { return static_cast<Index>(triangles_.size()); }
  Index slots() const { return 2 * size(); }
  const std::vector<std::array<Index, 3>>& cells() const { return triangles_; }

  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for (Index e = 0; e < size(); ++e) {
      const auto [first, second, third] = triangles_[place(e)];
      visit(first, 2 * e, -1);
      visit(first, 2 * e + 1, -1);
      visit(second, 2 * e, +1);
      visit(third, 2 * e + 1, +1);
    }
  }

  void internal_force(const Configuration& at, std::span<double> slots, core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  /// With the moduli of the taut sheet, which those of a wrinkled or slack one never exceed.
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
    for (Index e = 0; e < size(); ++e) spread(e, element_stiffness(at, e), sink);
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) spread(e, element_damping(at, e), sink);
  }

  SheetState state(const Configuration& at, Index e) const noexcept;
  /// Second Piola-Kirchhoff stress in material axes (Pa).
  PlaneStress<double> stress(const Configuration& at, Index e) const noexcept;
  const MembranePart& part() const { return part_; }
  MembraneTriangle<double> triangle(Index e) const noexcept;

 private:
  static constexpr Index lanes = static_cast<Index>(Lanes::size());
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  std::array<Triple<double>, 2> relative(std::span<const double> values, Index e) const noexcept;
  MembraneTriangle<double>::Deformation deformation(const Configuration& at, Index e) const noexcept;
  Matrix9 element_stiffness(const Configuration& at, Index e) const;
  Matrix9 element_damping(const Configuration& at, Index e) const;
  template <class Sink>
  void spread(Index e, const Matrix9& K, const Sink& sink) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sink(triangles_[place(e)][static_cast<std::size_t>(i)],
             triangles_[place(e)][static_cast<std::size_t>(j)], Matrix3(K.block<3, 3>(3 * i, 3 * j)));
  }
  /// stress_of(triangle, deformation, nodes of each lane by corner) in the slots of a pack.
  template <class StressOf>
  void fill_pack(const Configuration& at, std::span<double> slots, Index pack,
                 const StressOf& stress_of) const noexcept;
  template <class FillPack>
  static void for_each_pack(core::Block elements, const FillPack& fill) noexcept;
  /// Slots of K times a direction with the given moduli.
  void product(const Configuration& at, std::span<const double> direction, const PlaneMatrix& moduli, Index e,
               std::span<double> slots) const noexcept;

  MembranePart part_;
  Law law_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::array<std::array<Index, Lanes::size()>, 3>> nodes_;  ///< of each pack, by corner and lane
  std::vector<MembraneTriangle<Lanes>> packs_;  ///< the last one filled up with nothing
};

using PlainMembraneBatch = MembraneBatch<LinearSheet>;
using TensionFieldBatch = MembraneBatch<TensionField<ExactWrinkles>>;
using PrincipalTensionFieldBatch = MembraneBatch<TensionField<PrincipalWrinkles>>;
extern template class MembraneBatch<LinearSheet>;
extern template class MembraneBatch<TensionField<ExactWrinkles>>;
extern template class MembraneBatch<TensionField<PrincipalWrinkles>>;

}  // namespace talus::fem
