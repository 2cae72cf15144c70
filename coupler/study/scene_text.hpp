#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::study {

/// The text of a scene that lays settings over another one, the later over the earlier.
/// @param base as a scene in the folder of the new one names it
std::string scene_text(const std::vector<Setting>& settings, const std::filesystem::path& base);

}  // namespace talus::study
