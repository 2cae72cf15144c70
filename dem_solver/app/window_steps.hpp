#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "coupler/participant.hpp"
#include "dem_solver/app/window_force.hpp"
#include "dem_solver/boundary/light_nodes.hpp"
#include "dem_solver/solver.hpp"

namespace talus::dem {

/// The particles' steps of a window: on a boundary that moves from the window's start to its end, with the
/// forces handed back at the time level at which they are asked for.
class WindowSteps {
 public:
  /// What comes from the coupler: Ω_D behind the scene's own boundaries, which nothing moves.
  struct Interface {
    Index first_node = 0;                   ///< of Ω_D
    std::span<const double> node_masses{};  ///< kg; of Ω_D, outlives this
    Boundary::Cells cells{};                ///< of Ω_D
  };
  /// @param longest s; of a step; absent: one step a window
  WindowSteps(ParticleSolver& solver, const Interface& interface, std::optional<double> longest);

  /// Computes the window of this command and fills the fields that go out.
  void advance(const coupler::Command& command, const coupler::ParticleFields& fields);
  /// J; of the last window's forces on Ω_D; nothing where its motion at the window's end is not known yet.
  std::optional<double> work() const { return work_; }
  std::int64_t force_evaluations() const { return force_evaluations_; }

  void save();
  /// @throws UsageError where nothing was saved
  void restore();
  /// What the next window depends on besides the solver.
  void archive(core::StateArchive& archive) { force_.archive(archive); }

 private:
  struct Window;
  void move_boundary(ParticleSolver& solver, const Window& window, std::int64_t step) const;
  void collect(const ParticleSolver& solver, const Window& window, std::int64_t step);
  void note_place();
  void book_jump(const Window& window);
  void look_at_end(const Window& window);
  void tell_where_nodes_went(const Window& window) const;

  ParticleSolver& solver_;
  Interface interface_;
  std::optional<double> longest_step_;
  WindowForce force_;
  std::optional<LightNodes> light_nodes_;  ///< where the scheme asks for them
  std::vector<double> place_before_;       ///< m; of Ω_D at the last forces of the window before
  std::optional<double> work_;
  std::optional<ParticleSolver> ahead_;  ///< a step further; its memory is kept from window to window
  std::int64_t force_evaluations_ = 0;   ///< since the start
  struct Saved {
    ParticleSolver solver;
    WindowForce force;
  };
  std::optional<Saved> saved_;
};

}  // namespace talus::dem
