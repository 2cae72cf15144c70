#pragma once

#include <span>
#include <vector>

#include "dem_solver/boundary/feature_grid.hpp"
#include "dem_solver/collision/slot_move.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// An accepted contact of a sphere with the boundary.
struct BoundaryContact {
  Row force;        ///< N; on the sphere at the last evaluation
  Row normal;       ///< unit vector to the sphere's centre; w: m, distance of the feature from it
  Weights weights;  ///< of the feature's nodes at the contact point
  Index feature = -1;
  Index part = -1;
};

/// The features near each sphere, and room for its contacts: one slot a candidate, of which the first `count`
/// are contacts.
///
/// A contact belongs to the sphere and the boundary's part, not to a feature, so that its memory goes along
/// when the sphere rolls from one feature to the next.
class BoundaryList {
 public:
  /// The grid serves until the boundary has moved this many skins: building it costs more than searching a
  /// slightly larger box.
  static constexpr double grid_margin_in_skins = 4;

  /// @param new_place where the spheres of the previous list stand now.
  /// @return where the memory of each contact goes.
  std::vector<SlotMove> rebuild(const Boundary& boundary, const Spheres& spheres,
                                std::span<const Index> new_place, double skin);

  /// m; no node of the boundary has moved further since the list was built.
  double boundary_motion(const Boundary& boundary) const noexcept {
    return boundary.motion_bound(listed_displacement_);
  }

  /// Whether cells of the boundary were lost since.
  bool has_lost_cells(const Boundary& boundary) const noexcept { return listed_losses_ != boundary.losses(); }

  /// Spheres with candidates; those of the k-th are candidates()[first()[k]] .. candidates()[first()[k + 1]],
  /// the place is the slot.
  std::span<const Index> spheres() const noexcept { return spheres_; }
  std::span<const Index> first() const noexcept { return first_; }
  std::span<const Index> candidates() const noexcept { return candidates_; }
  Index slots() const noexcept { return static_cast<Index>(candidates_.size()); }
  /// Contacts of the k-th sphere: contacts()[first()[k]] .. + count()[k].
  std::span<BoundaryContact> contacts() noexcept { return contacts_; }
  std::span<const BoundaryContact> contacts() const noexcept { return contacts_; }
  std::span<Index> count() noexcept { return count_; }
  std::span<const Index> count() const noexcept { return count_; }
  Index most_candidates() const noexcept;

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("spheres", self.spheres_);
    visit("first", self.first_);
    visit("candidates", self.candidates_);
    visit("count", self.count_);
    visit("contacts", self.contacts_);
    visit("listed_displacement", self.listed_displacement_);
  }

 private:
  std::vector<Index> spheres_, first_{0}, candidates_, count_;
  std::vector<BoundaryContact> contacts_;
  std::vector<double> listed_displacement_;   ///< of the boundary's nodes when the list was built
  std::vector<double> gridded_displacement_;  ///< and when the grid was; empty before
  std::int64_t listed_losses_ = 0;            ///< Boundary::losses() when the list was built
  FeatureGrid grid_;
};

}  // namespace talus::dem
