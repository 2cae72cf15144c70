#pragma once

#include <functional>
#include <string>

#include "core/scene/reader.hpp"
#include "core/scene/tree.hpp"

/// Looking into a scene whose keys belong to the solvers.
namespace talus::accuracy {

/// The scene after everything it extends.
core::SceneNode effective_tree(const core::SceneFile& scene);
/// "structure.parts.net.cable", "particles.contacts[0].friction"; null where nothing stands there.
const core::SceneNode* node_at(const core::SceneNode& tree, const std::string& path);
/// Every key with a single value, with its path: "time.step", "50 us". Lists are not entered.
void for_each_value(const core::SceneNode& tree,
                    const std::function<void(const std::string& path, const std::string& value)>& visit);

}  // namespace talus::accuracy
