#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::tune {

/// A setting with the reason it stands in the overlay for.
struct Reasoned {
  study::Setting setting;
  std::string reason;
};

/// A scene of a few lines over another one, each key with its reason as a comment behind it.
/// @param base as the new scene's folder names it
/// @param heading lines of comment above
std::string overlay_text(const std::filesystem::path& base, const std::string& title,
                         const std::vector<std::string>& heading, const std::vector<Reasoned>& settings);

}  // namespace talus::tune
