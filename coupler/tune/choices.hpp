#pragma once

#include <filesystem>
#include <vector>

#include "coupler/tune/candidate.hpp"

namespace talus::core {
class SceneFile;
}

/// What of a scene may be chosen another way.
namespace talus::tune {

/// Other ways to compute the same physics, the most independent first: contact implicit or explicit, strong
/// or weak coupling, an implicit structure in place of an explicit one where nothing is coupled. They serve
/// as families of the search, and as the second way to the truth.
std::vector<Change> other_methods(const core::SceneFile& scene);

/// Choices that change the model a little: slides by constraints in place of springs, the direction of
/// wrinkles, coarser meshes of
/// sheets and fillings of rocks.
std::vector<Change> other_models(const core::SceneFile& scene);

/// Twice the step of an explicit structure, whose light nodes get the mass that makes it stable. Nothing
/// where the structure is another one.
std::optional<Candidate> with_scaled_mass(const core::SceneFile& scene, const Candidate& candidate);

/// Effects that `talus explain` proposes to leave out of this result, each as a change that does.
std::vector<Change> effects_that_may_go(const core::SceneFile& scene, const std::filesystem::path& result);

}  // namespace talus::tune
