#include "coupler/accuracy/scene_tree.hpp"

#include <charconv>

namespace talus::accuracy {
namespace {

const core::SceneNode* child(const core::SceneNode* node, const std::string& key) {
  if (node == nullptr) return nullptr;
  const auto* entry = node->find(key);
  return entry ? &entry->value : nullptr;
}

const core::SceneNode* item(const core::SceneNode* node, const std::string& number) {
  std::size_t index = 0;
  std::from_chars(number.data(), number.data() + number.size(), index);
  return node != nullptr && index < node->items.size() ? &node->items[index] : nullptr;
}

void visit_values(const core::SceneNode& node, const std::string& path,
                  const std::function<void(const std::string&, const std::string&)>& visit) {
  if (node.kind == core::SceneNode::Kind::scalar) visit(path, node.scalar);
  for (const auto& entry : node.entries)
    visit_values(entry.value, path.empty() ? entry.key : path + "." + entry.key, visit);
}

}  // namespace

core::SceneNode effective_tree(const core::SceneFile& scene) {
  std::vector<core::Complaint> complaints;
  return core::parse_yaml(scene.text(), scene.path(), complaints);
}

const core::SceneNode* node_at(const core::SceneNode& tree, const std::string& path) {
  const core::SceneNode* node = &tree;
  for (std::size_t begin = 0; begin < path.size() && node != nullptr;) {
    const bool in_list = path[begin] == '[';
    const std::size_t end = in_list ? path.find(']', begin) : path.find_first_of(".[", begin);
    const std::string name =
        in_list ? path.substr(begin + 1, end - begin - 1) : path.substr(begin, end - begin);
    node = in_list ? item(node, name) : child(node, name);
    if (end == std::string::npos) break;
    begin = path[end] == '[' ? end : end + 1;
    if (begin < path.size() && path[begin] == '.') ++begin;
  }
  return node;
}

void for_each_value(const core::SceneNode& tree,
                    const std::function<void(const std::string& path, const std::string& value)>& visit) {
  visit_values(tree, {}, visit);
}

}  // namespace talus::accuracy
