#pragma once

#include <optional>
#include <span>
#include <vector>

#include "coupler/schemes/commands.hpp"
#include "coupler/session/session.hpp"
#include "coupler/work_meter.hpp"
#include "interface_mesh/mapping.hpp"

namespace talus::core {
class StateArchive;
}

namespace talus::coupler {

/// What a coupling scheme is written in: the two sides, and the mapping between their arrays, which stand in
/// shared memory; values are mapped straight from one side's array into the other's. Where Ω_D is Ω_S and the
/// sides run in turn, both have the same arrays, and there is nothing to map.
class Exchange {
 public:
  /// A side's arrays, 3 values a node. Of the structure only the first three exist.
  struct Side {
    Peer& peer;
    std::span<double> force, displacement, velocity;  ///< of the boundary: motion at the window's start
    std::span<double> end_displacement,
        end_velocity;                 ///< empty: the particles do not look at the window's end
    std::span<double> free_velocity;  ///< empty: the particles do not ask for it
    std::span<double> moved_displacement,
        moved_velocity;      ///< empty: the boundary moves as it is told
    std::span<double> lost;  ///< one value a cell; empty: none is ever lost
  };

  /// @pre the session's arrays are laid out; `mapping` lives as long as this
  Exchange(Session& session, const mesh::Mapping& mapping);

  /// Before the first window, once the structure has answered to something: its motion at time 0.
  void start() { motion_to_boundary(); }

  // The participants' parts of a window; each returns when the answers are there. An iteration is given where
  // the window may be taken back.
  void advance_particles(const Window& window, std::optional<int> iteration = {});
  void advance_structure(const Window& window, std::optional<int> iteration = {});
  void advance_both(const Window& window, std::optional<int> iteration = {});
  void save_states(const Window& window);
  void restore_states(const Window& window);
  /// Everything is as it was when the states were saved, the last forces included: another scheme, or windows
  /// of another length, may begin here.
  void take_back(const Window& window);

  // Explicit schemes: straight from array to array.
  /// f_S = W^T f_D. Skipped while nothing touches: the forces of the last window were zero, as are these; and
  /// where both sides use the same arrays.
  void forces_to_structure();
  /// u_D = W u_S, v_D = W v_S, as the boundary's motion at the start of the next window. Nothing to do where
  /// both sides use the same arrays.
  void motion_to_boundary();
  /// The boundary's motion at the window's end as the start's motion promises it: u + v length, v. Only for
  /// particles that take several steps a window; others do not look at it.
  void extrapolate_boundary_end(const Window& window);

  // Windows that may be taken back.
  void load_structure(std::span<const double> boundary_force) {
    mapping_.to_structure(boundary_force, structure_.force);
  }
  void release_structure();
  /// The structure's present motion, as the boundary's at the window's end. Only for particles that take several steps
  /// a window; others do not look at it.
  void motion_to_boundary_end();
  /// What a window of a strong scheme settles on after its iterations.
  void accept_window();

  const mesh::Mapping& mapping() const { return mapping_; }
  Side& structure() { return structure_; }
  Side& particles() { return particles_; }

  /// Work since the start, J.
  double work_on_structure() const { return structure_.peer.work(); }
  /// Of windows of weak schemes up to the last command: what the last window's forces did is known once the
  /// particles meet the boundary's new place. Where both sides have the same arrays, the structure's sum.
  double work_on_boundary() const { return one_set_ ? work_on_structure() : particles_.peer.work(); }
  /// The arrays of both sides and the works: all that later windows depend on.
  void archive(core::StateArchive& archive);
  /// Whether the particles' last forces are not all zero.
  bool touching() const;

 private:
  /// Says, too, at which time level the structure wants the forces.
  Command advance_of_particles(const Window& window, std::optional<int> iteration) const;
  /// What broke up to a window's end is gone for the particles from the next one on.
  void losses_to_boundary();
  /// J; of a window that was taken back or might have been: what the side says, else the sum over its nodes.
  double work_of(const Side& side, const WorkMeter::Motion& start, std::span<const double> end) const;

  Session& session_;
  const mesh::Mapping& mapping_;
  Side structure_, particles_;
  bool one_set_;                                                    ///< both sides have the same arrays
  std::vector<double> structure_start_, structure_start_velocity_;  ///< m, m/s; when the states were saved
  double saved_length_ = 0;                                         ///< s; of the window that begins there
  std::vector<double> force_start_;                                 ///< N; on the boundary then
  bool touched_ = false;
};

}  // namespace talus::coupler
