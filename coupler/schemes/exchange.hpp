#pragma once

#include <cstdint>
#include <span>

#include "coupler/schemes/work_meter.hpp"
#include "coupler/session/session.hpp"
#include "interface_mesh/mapping.hpp"

namespace talus::coupler {

/// One window: time = index x length, never accumulated.
struct Window {
  std::int64_t index = 0;
  double length = 0;  ///< s
  double start() const { return static_cast<double>(index) * length; }
};

/// The command to compute this window.
Command advance(const Window& window, int iteration = 0);

/// What a coupling scheme is written in: the two sides, and the mapping between their arrays, which stand in
/// shared memory; values are mapped straight from one side's array into the other's.
class Exchange {
 public:
  /// @pre the session's arrays are laid out; `mapping` lives as long as this
  Exchange(Session& session, const mesh::Mapping& mapping);

  /// Before the first window, once the structure has answered to something: its motion at time 0.
  void start() { motion_to_boundary(); }

  // The participants' parts of a window; each returns when the answer is there.
  void advance_particles(const Window& window, int iteration = 0);
  void advance_structure(const Window& window, int iteration = 0);

  /// f_S = W^T f_D. Skipped while nothing touches: the forces of the last window were zero, as are these.
  void forces_to_structure();
  /// u_D = W u_S, v_D = W v_S, as the boundary's motion at the start of the next window.
  void motion_to_boundary();
  /// The boundary's motion at the window's end as the start's motion promises it: u + v length, v. Only for
  /// particles that take several steps a window; others do not look at it.
  void extrapolate_boundary_end(const Window& window);

  /// Work since the start, J.
  double work_on_structure() const { return structure_work_.joules(); }
  double work_on_boundary() const { return boundary_work_.joules(); }
  bool touching() const { return touching_; }

 private:
  struct Side {
    Peer& peer;
    std::span<double> force, displacement, velocity, end_displacement, end_velocity, free_velocity;
  };
  static Side side(Session& session, Role role);

  Session& session_;
  const mesh::Mapping& mapping_;
  Side structure_, particles_;
  WorkMeter structure_work_, boundary_work_;
  bool touching_ = false;
};

}  // namespace talus::coupler
