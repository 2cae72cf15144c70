#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/accuracy/estimate.hpp"
#include "coupler/study/study_scene.hpp"

namespace talus::core {
class SceneFile;
}

/// What the numbers of a run can be off by, and how another run shows it.
namespace talus::accuracy {

/// One reason why a run differs from the truth.
struct Cause {
  std::string name;     ///< "window", "step of the structure", "mesh of sheet"
  std::string changes;  ///< what its companions change, for people
  Orders expected;
  std::vector<double> coarser;  ///< sizes to look at first, as they cost less than the run
  std::vector<double> finer;
  /// What makes the scene a companion of this size; nothing where that cannot be: the steps do not divide the
  /// window, or would be above a limit.
  std::function<std::optional<std::vector<study::Setting>>(double size)> settings;
};

/// The causes of a coupled or a single scene: steps of each side, the window, meshes and fillings that the
/// scene names a size of, the tolerance of a strong scheme, load steps.
/// @param summary of the run
std::vector<Cause> causes_of(const core::SceneFile& scene, const nlohmann::json& summary);

}  // namespace talus::accuracy
