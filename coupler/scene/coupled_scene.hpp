#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/sections.hpp"
#include "coupler/scene/coupling_scene.hpp"
#include "coupler/scene/interface_scene.hpp"

namespace talus::coupler {

/// A scene as the coupler sees it. The sections `structure` and `particles` belong to the solvers; only their
/// key `solver` is read here.
struct CoupledScene {
  core::TimeScene time;
  core::OutputScene output;
  CouplingScene coupling;
  std::optional<InterfaceScene> interface;
  std::optional<core::SolverScene> structure, particles;

  /// s; the regular one. As long as the scene says where that divides the run, else shorter, so that the run
  /// ends with a window (core::equal_steps).
  double window() const;
  /// s; 0: none, as a scene of a single side may: that side's step then is the window
  double named_window() const { return coupling.window.value_or(time.step.value_or(0)); }
  /// In regular windows; 1 where windows do not grow.
  std::int64_t longest_window() const;
  /// How often a window that does not converge may be cut in half.
  std::int64_t most_halvings() const;
};

/// Reads everything the coupler needs. Complaints are returned, not thrown: those of the solvers are to come
/// with them.
CoupledScene read_coupled_scene(const core::SceneFile& file, std::vector<core::Complaint>& complaints);

}  // namespace talus::coupler
