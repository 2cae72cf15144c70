#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "dem_solver/boundary/closest_point.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// A segment or triangle of the boundary.
struct Feature {
  std::array<Index, 3> nodes{-1, -1, -1};  ///< the third is -1 for a segment
  double wire_radius = 0;                  ///< m; 0 for triangles
  Index material = 0;
  Index part = 0;

  bool is_segment() const noexcept { return nodes[2] < 0; }
};

/// The boundary Ω_D of all rigid surfaces: nodes that move as they are told, and collect the reactions of the
/// contacts.
class Boundary {
 public:
  Boundary() = default;
  /// @param material_of_part index of each part's contact material.
  Boundary(const mesh::Surface& surface, std::span<const Index> material_of_part);

  bool empty() const noexcept { return features_.empty(); }
  std::span<const Feature> features() const noexcept { return features_; }
  Index node_count() const noexcept { return static_cast<Index>(reaction_.size()); }
  const std::vector<std::string>& part_names() const noexcept { return part_names_; }

  /// Where a node is now (m) and how fast (m/s). Put together where it is asked for: contacts are with few
  /// nodes, and of the others nothing is needed but their displacement.
  Triple<double> position(Index node) const noexcept {
    return at(reference_, node) + at(displacement_, node);
  }
  Triple<double> velocity(Index node) const noexcept { return at(velocity_, node); }
  /// m; from the reference state, 3 a node.
  std::span<const double> displacement() const noexcept { return displacement_; }
  /// N; of the last evaluation. Zero but for the loaded nodes, which are listed once each.
  std::span<const Row> reaction() const noexcept { return reaction_; }
  std::span<const Index> loaded_nodes() const noexcept { return loaded_nodes_; }

  /// Displacement from the reference state and velocity at the two ends of a window, 3 values a node, of the
  /// nodes from `first_node` on. Between the ends they move on the parabola through both displacements whose
  /// velocity changes by what the given velocities differ,
  ///
  ///     u(x) = u0 + x (u1 - u0) + L (v1 - v0) x (x - 1)/2        v(x) = (u1 - u0)/L + (v1 - v0)(x - 1/2)
  ///
  /// | symbol | meaning                                                    | unit   |
  /// |--------|------------------------------------------------------------|--------|
  /// | u, v   | displacement, velocity; 0 and 1 at the window's ends       | m, m/s |
  /// | x      | part of the window that is over                            | 1      |
  /// | L      | length of the window                                       | s      |
  ///
  /// which is of third order in L for u, of second for v, whether the given velocities are those at the ends or,
  /// as a leapfrog has them, those a part of a step before both.
  struct Motion {
    std::span<const double> start_displacement, start_velocity;
    std::span<const double> end_displacement, end_velocity;  ///< empty: only the start is known
    double length = 0;  ///< s; of the window; not looked at without an end
    Index first_node = 0;

    /// m/s; of node i (from `first_node` on) at the part x of the window. @pre the end is known
    Triple<double> velocity(std::size_t i, double x) const noexcept;
  };
  /// Which moment of the window: displacements of one time, velocities of another (those of particles are half
  /// a step old when forces are evaluated).
  struct Moment {
    double displacement = 0, velocity = 0;  ///< as parts of the window
  };
  /// Sets the nodes to their state at a moment; to that of the start, whatever the moment, where the end is
  /// empty.
  void move(const Motion& motion, const Moment& moment) noexcept;
  /// Adds a displacement and a velocity, 3 values a node, to those of the nodes from `first_node` on.
  struct Addition {
    std::span<const double> displacement, velocity;
    Index first_node = 0;
  };
  void displace(const Addition& addition) noexcept;
  /// Prescribed motion: every node of a part keeps a velocity; positions follow from the time since the
  /// reference state.
  void set_velocity(Index part, const Triple<double>& velocity);
  void drift(double time) noexcept;

  /// The boundary as free nodes, for implicit contact: the mass behind each (kg; 0 or infinite: it moves as
  /// it is told), and from step to step the velocity (m/s, 3 a node) it would have half a step from now
  /// without contact.
  /// Both for the nodes from `first` on; those before it move as they are told.
  void set_node_masses(std::span<const double> masses, Index first);
  void set_free_velocity(std::span<const double> velocity, Index first) noexcept;
  std::span<const Row> free_velocity() const noexcept { return free_velocity_; }  ///< w: inverse mass

  /// Where the cells of a received surface stand among all of the boundary's.
  struct Cells {
    std::size_t first_segment = 0, segments = 0, first_triangle = 0;
  };
  /// Cells whose value is not 0 are gone: nothing meets them any more. @param lost one a received cell, segments before
  /// triangles
  void lose(const Cells& cells, std::span<const double> lost);
  bool is_lost(Index feature) const noexcept { return !lost_.empty() && lost_[feature] != 0; }
  /// Another number whenever other features are lost.
  std::int64_t losses() const noexcept { return losses_; }

  void clear_reactions() noexcept;
  /// Sets a contact's reaction -weights x force on the nodes of a feature.
  void react(const Feature& feature, const Weights& weights, const Triple<double>& force_on_sphere) noexcept;

  struct ClosestPoint {
    Weights weights;
    Triple<double> point;  ///< m; on the axis of a wire
  };
  ClosestPoint closest(const Feature& feature, const Triple<double>& p) const noexcept;
  Triple<double> velocity_at(const Feature& feature, const Weights& weights) const noexcept;

  /// m; no node is further than this from where it was at an earlier displacement(). Above the largest
  /// distance by less than sqrt(3), and equal to it where all nodes move along one axis.
  double motion_bound(std::span<const double> since) const noexcept;

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("displacement", self.displacement_);
    visit("velocity", self.velocity_);
    visit("reaction", self.reaction_);
    visit("loaded_nodes", self.loaded_nodes_);
    visit("lost", self.lost_);
  }

 private:
  static Triple<double> at(const std::vector<double>& values, Index node) noexcept {
    const double* v = values.data() + 3 * static_cast<std::size_t>(node);
    return {v[0], v[1], v[2]};
  }
  static void set(std::vector<double>& values, Index node, const Triple<double>& v) noexcept;
  void react_at(Index node, const Triple<double>& force) noexcept;

  std::vector<Feature> features_;
  std::vector<Index>
      cell_of_feature_;      ///< number of its segment, or -1 less that of its triangle, in the surface
  std::vector<Index> lost_;  ///< 1 for each feature that is gone; empty: none has ever been
  std::int64_t losses_ = 0;
  std::vector<std::string> part_names_;
  std::vector<Index> part_of_node_;
  std::vector<double> reference_, displacement_, velocity_;  ///< 3 a node
  std::vector<Row> reaction_;                                ///< w: not 0 where the node is listed as loaded
  std::vector<Index> loaded_nodes_;
  std::vector<Index> drifting_;     ///< nodes of prescribed velocity
  std::vector<Row> free_velocity_;  ///< w: inverse mass; empty where contact is explicit
};

}  // namespace talus::dem
