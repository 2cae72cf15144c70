#include "coupler/tune/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/tree.hpp"

namespace talus::tune {
namespace {

/// Maps in the order in which their keys come.
struct Branch {
  std::string key;
  std::vector<Branch> below{};
  const Reasoned* leaf = nullptr;

  Branch& at(const std::string& name) {
    const auto found = std::ranges::find(below, name, &Branch::key);
    if (found != below.end()) return *found;
    below.push_back({.key = name});
    return below.back();
  }
};

void add(Branch& root, const Reasoned& reasoned) {
  Branch* branch = &root;
  const std::string& path = reasoned.setting.key;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    branch = &branch->at(path.substr(begin, end - begin));
    begin = end + 1;
  }
  branch->leaf = &reasoned;
}

void write(const Branch& branch, std::size_t depth, std::string& text) {
  const std::string indent(2 * depth, ' ');
  for (const auto& one : branch.below) {
    if (one.leaf != nullptr) {
      text += fmt::format("{}{}: {}  # {}\n", indent, one.key, one.leaf->setting.value, one.leaf->reason);
    } else {
      text += indent + one.key + ":\n";
      write(one, depth + 1, text);
    }
  }
}

}  // namespace

std::string overlay_text(const std::filesystem::path& base, const std::string& title,
                         const std::vector<std::string>& heading, const std::vector<Reasoned>& settings) {
  std::string text;
  for (const auto& line : heading) text += "# " + line + "\n";
  const auto quoted = [](const std::string& value) {
    return core::canonical_text({core::SceneNode::Kind::scalar, {}, value});
  };
  text += "extends: " + quoted(base.string()) + "\ntitle: " + quoted(title) + "\n";
  Branch root{.key = {}};
  for (const auto& setting : settings) add(root, setting);
  write(root, 0, text);
  return text;
}

}  // namespace talus::tune
