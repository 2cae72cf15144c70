#pragma once

#include <span>
#include <vector>

#include "dem_solver/boundary/feature_grid.hpp"
#include "dem_solver/collision/slot_move.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// Which of the features that a sphere overlaps count as contacts.
///
/// local_minima: every local minimum of the distance from the centre on one connected surface, as far as it stands out from
/// the nearer one beside it. With L the distance of a minimum, R the sphere's radius and L_s that of the lowest saddle on a
/// way along the surface to a nearer minimum, its overlap is
///
///     h = min(R, L_s) - L
///
/// (the 0-dimensional persistence of the distance on the surface). The force is the derivative of the energy of that overlap:
/// f n at the minimum, and -f n_s at a saddle that limits it. So a floor of triangles is one contact, a concave edge becomes
/// two as its angle grows without a step of the energy, and wires that are not connected all count. Tests:
/// touching_features.cpp, verification/particles "features".
///
/// tangent_plane: a candidate is dropped where its contact point lies on or beyond the tangent plane of a nearer accepted
/// one,
///     n_new . n_old L_new >= L_old        n: unit vectors to the centre, L: distances of the contact points from it
/// as published curves were made. It appears and disappears with a finite overlap, and of separate wires it may keep one only.
/// Test: verification/particles "triangulated floor".
enum class ContactRule { local_minima, tangent_plane };

/// Where a contact ends, on the way along the surface to a nearer one.
struct FeatureSaddle {
  Triple<double> normal;  ///< unit vector to the sphere's centre
  Weights weights;
  Index feature = -1;  ///< that it lies on; -1: there is none
};

/// An accepted contact of a sphere with the boundary.
struct BoundaryContact {
  Row force;        ///< N; on the sphere at the last evaluation
  Row normal;       ///< unit vector to the side that the sphere is on; w: m, distance of its centre to that
                    ///< side, negative where it was pressed through a face
  Weights weights;  ///< of the feature's nodes at the contact point
  Index feature = -1;
  Index part = -1;
  double reach = 0;      ///< m; distance from the centre at which the overlap is 0
  FeatureSaddle saddle;  ///< that the sphere is drawn to by the normal force
  FeatureSaddle pulled;  ///< the saddle of the last evaluation, and
  Triple<double> pull;   ///< N; the normal force on the sphere that was directed there
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
