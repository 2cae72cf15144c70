#include "core/scene/tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/utf8.hpp"

namespace talus::core {

std::string text(const Place& place) {
  const std::string file = place.file ? place.file->string() : std::string();
  return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

SceneNode::SceneNode(Kind a_kind, Place a_place, std::string a_scalar)
    : kind(a_kind), place(std::move(a_place)), scalar(std::move(a_scalar)) {}

const SceneEntry* SceneNode::find(const std::string& key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

SceneEntry* SceneNode::find(const std::string& key) {
  return const_cast<SceneEntry*>(static_cast<const SceneNode*>(this)->find(key));
}

std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;
  std::string line = text.substr(0, longest);
  if (text.size() > longest) line.resize(utf8_length(line));  // cut between characters
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return fmt::format("'{}{}'", line, text.size() > longest ? "..." : "");
}

std::string shown(const SceneNode& node) {
  switch (node.kind) {
    case SceneNode::Kind::null:
      return "nothing";
    case SceneNode::Kind::scalar:
      return quoted(node.scalar);
    case SceneNode::Kind::list:
      return fmt::format("a list of {}", node.items.size());
    case SceneNode::Kind::map:
      return "a map of keys";
  }
  return {};
}

Complaint complaint(const Place& place, const std::string& key_path, const std::string& message) {
  return {.file = place.file ? place.file->string() : std::string(),
          .line = place.line,
          .column = place.column,
          .key_path = key_path,
          .message = message};
}

SceneNode overlay(SceneNode base, const SceneNode& over, int rank) {
  if (base.kind != SceneNode::Kind::map || over.kind != SceneNode::Kind::map)
    base = SceneNode(over.kind, over.place);
  base.place = over.place;
  base.scalar = over.scalar;
  base.items = over.items;
  for (const auto& entry : over.entries) {
    auto* present = base.find(entry.key);
    if (present && entry.value.kind == SceneNode::Kind::null) {
      base.entries.erase(base.entries.begin() + (present - base.entries.data()));
    } else if (present) {
      *present = {entry.key, entry.place, rank, overlay(std::move(present->value), entry.value, rank)};
    } else {
      base.entries.push_back({entry.key, entry.place, rank, overlay({}, entry.value, rank)});
    }
  }
  return base;
}

namespace {

std::string double_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < ' ') {
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace

std::string canonical_text(const SceneNode& node) {
  std::string inner;
  switch (node.kind) {
    case SceneNode::Kind::null:
      return "null";
    case SceneNode::Kind::scalar:
      return double_quoted(node.scalar);
    case SceneNode::Kind::list:
      for (const auto& item : node.items) inner += (inner.empty() ? "" : ", ") + canonical_text(item);
      return "[" + inner + "]";
    case SceneNode::Kind::map:
      for (const auto& entry : node.entries)
        inner += (inner.empty() ? "" : ", ") + double_quoted(entry.key) + ": " + canonical_text(entry.value);
      return "{" + inner + "}";
  }
  return {};
}

namespace {

/// Levenshtein's distance: the least number of inserted, deleted and replaced characters.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t longest_name = 80;  // a longer one is no slip of the fingers
  if (name.size() > longest_name) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const auto& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace talus::core
