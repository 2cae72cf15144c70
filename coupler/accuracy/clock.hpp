#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::core {
class SceneFile;
}

/// The steps and windows of a run, and how they are tied to each other.
namespace talus::accuracy {

/// One side of a run as far as its step goes.
struct SideClock {
  std::string name;    ///< "structure"
  double step = 0;     ///< s
  double largest = 0;  ///< s; the largest step within the limits it declared; 0: above one already
  double mass_step =
      0;  ///< s; that light nodes get mass for (`mass_scaling`), which goes with the step; 0: none
  bool named = false;    ///< a step of its own stands in the scene
  bool foreign = false;  ///< a program of somebody else's: only its window can be changed
  bool fixed = false;    ///< a static structure, which has load steps in place of it
};

/// The steps of a run.
struct Clock {
  double window = 0;  ///< s
  std::vector<SideClock> sides;
  bool coupled = false;       ///< by an interface: without one the window is nothing but the beat of output
  bool names_window = false;  ///< `coupling.window` stands in the scene

  /// Whether the side takes one step a window, so that neither can be varied alone.
  bool is_tied(const SideClock& side) const;
  std::vector<std::string> tied() const;
};

/// Which limits a longer step has to keep.
enum class Limits { all, stability };

/// The clock of a run that ended. @param summary of the run; it says windows, steps and limits
Clock clock_of(const core::SceneFile& scene, const nlohmann::json& summary, Limits limits = Limits::all);

/// The clock with the step of this side, in the same windows, times `factor`. Nothing where that does not
/// divide the window, would be above a limit of the side, or cannot be written into the scene.
std::optional<Clock> with_step(const Clock& clock, const std::string& side, double factor);
/// The clock with the window and all steps that are tied to it times `factor`; other steps stay. Nothing
/// where that cannot be.
std::optional<Clock> with_window(const Clock& clock, double factor);
/// Everything times `factor`.
std::optional<Clock> with_all(const Clock& clock, double factor);

/// The keys that give a scene this clock; none for that of no sides. A side that is tied to the window takes
/// `time.step`, as implicit contact wants it.
std::vector<study::Setting> settings_of(const Clock& clock);

}  // namespace talus::accuracy
