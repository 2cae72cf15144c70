#include "core/scene/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <set>
#include <sstream>
#include <tuple>

#include "core/input_file.hpp"
#include "core/program/log.hpp"
#include "core/scene/section_reader.hpp"
#include "core/scene/tree.hpp"

namespace talus::core {

const std::vector<std::string>& scene_sections() {
  static const std::vector<std::string> sections{"title",     "extends",  "time",   "structure", "particles",
                                                 "interface", "coupling", "output", "regression"};
  return sections;
}

struct SceneFile::Content {
  std::filesystem::path path;
  SceneNode root;
  int rank = 0;                       ///< of the latest overlay
  std::vector<Complaint> complaints;  ///< about duplicate keys
};

namespace {

constexpr std::size_t longest_chain = 16;  // files that extend each other

std::string file_text(const std::filesystem::path& path, const Complaint& if_unreadable) {
  try {
    return text_of_file(path);
  } catch (const ConfigError& error) {
    Complaint problem = if_unreadable;
    problem.message = error.what();
    throw ConfigError(std::vector{problem});
  }
}

struct LoadedTree {
  SceneNode root;
  int rank = 0;
};

/// A file of the chain of `extends`.
struct Link {
  std::filesystem::path path;
  std::vector<std::filesystem::path> above;  ///< the files that led here
};

LoadedTree tree_of(const std::string& text, const Link& link, std::vector<Complaint>& complaints);

LoadedTree base_of(const SceneEntry& extends, const Link& link, std::vector<Complaint>& complaints) {
  Complaint problem = complaint(extends.value.place, "extends", "");
  if (extends.value.kind != SceneNode::Kind::scalar) {
    problem.message = "expects the path of a scene, got " + shown(extends.value);
    throw ConfigError(std::vector{problem});
  }
  const auto base = (link.path.parent_path() / extends.value.scalar).lexically_normal();
  Link next{base, link.above};
  next.above.push_back(std::filesystem::weakly_canonical(link.path));
  const bool loops = std::find(next.above.begin(), next.above.end(),
                               std::filesystem::weakly_canonical(base)) != next.above.end();
  if (loops || next.above.size() > longest_chain) {
    problem.message = loops ? "extends itself, through " + quoted(base.string())
                            : fmt::format("more than {} files extend each other", longest_chain);
    throw ConfigError(std::vector{problem});
  }
  return tree_of(file_text(base, problem), next, complaints);
}

/// A solver that is named by a word alone becomes the section it stands for.
void spell_out_solvers(SceneNode& root) {
  for (const char* const side : {"structure", "particles"}) {
    SceneEntry* const section = root.find(side);
    SceneEntry* const solver = section == nullptr ? nullptr : section->value.find("solver");
    if (solver == nullptr || solver->value.kind != SceneNode::Kind::scalar) continue;
    SceneNode program = std::move(solver->value);
    solver->value = SceneNode(SceneNode::Kind::map, program.place);
    solver->value.entries.push_back({"program", program.place, solver->rank, std::move(program)});
  }
}

LoadedTree tree_of(const std::string& text, const Link& link, std::vector<Complaint>& complaints) {
  SceneNode own = parse_yaml(text, link.path, complaints);
  if (own.kind != SceneNode::Kind::map) throw ConfigError(complaints);
  spell_out_solvers(own);
  const SceneEntry* extends = own.find("extends");
  if (!extends) return {std::move(own), 0};
  LoadedTree base = base_of(*extends, link, complaints);
  own.entries.erase(own.entries.begin() + (extends - own.entries.data()));
  return {overlay(std::move(base.root), own, base.rank + 1), base.rank + 1};
}

}  // namespace

SceneFile::SceneFile() : content_(std::make_unique<Content>()) {}
SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;

SceneFile SceneFile::load(const std::filesystem::path& path) {
  return parse(file_text(path, {.file = {}}), path);
}

SceneFile SceneFile::parse(const std::string& text, const std::filesystem::path& name) {
  SceneFile file;
  file.content_->path = name;
  auto tree = tree_of(text, {name, {}}, file.content_->complaints);
  file.content_->root = std::move(tree.root);
  file.content_->rank = tree.rank;
  return file;
}

const std::filesystem::path& SceneFile::path() const {
  return content_->path;
}

std::string SceneFile::title() const {
  const SceneEntry* title = content_->root.find("title");
  return title && title->value.kind == SceneNode::Kind::scalar ? title->value.scalar
                                                               : content_->path.stem().string();
}

std::filesystem::path SceneFile::resolve(const std::string& written) const {
  return content_->path.parent_path() / written;
}

std::filesystem::path SceneFile::path_at(const std::string& key_path) const {
  const SceneNode* node = &content_->root;
  std::istringstream keys(key_path);
  for (std::string key; node != nullptr && std::getline(keys, key, '.');) {
    const SceneEntry* entry = node->find(key);
    node = entry == nullptr ? nullptr : &entry->value;
  }
  if (node == nullptr || node->kind != SceneNode::Kind::scalar) return {};
  const auto& file = node->place.file ? *node->place.file : content_->path;
  return file.parent_path() / node->scalar;
}

namespace {

void add_named_files(const SceneNode& node, const std::filesystem::path& folder,
                     std::set<std::filesystem::path>& found) {
  for (const auto& item : node.items) add_named_files(item, folder, found);
  for (const auto& entry : node.entries) add_named_files(entry.value, folder, found);
  if (node.kind != SceneNode::Kind::scalar || node.scalar.empty()) return;
  const auto from = node.place.file ? node.place.file->parent_path() : folder;
  const auto path = (from / node.scalar).lexically_normal();
  std::error_code not_a_path;
  if (std::filesystem::is_regular_file(path, not_a_path)) found.insert(path);
}

}  // namespace

std::vector<std::filesystem::path> SceneFile::named_files() const {
  std::set<std::filesystem::path> found;
  add_named_files(content_->root, content_->path.parent_path(), found);
  return {found.begin(), found.end()};
}

std::string SceneFile::text() const {
  return canonical_text(content_->root);
}

/// FNV-1a, 64 bits: tells two scenes apart; no defence against forgery.
std::string SceneFile::hash() const {
  std::uint64_t digest = 0xcbf29ce484222325u;
  for (const char c : text()) digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", digest);
}

bool SceneFile::has_section(const std::string& key) const {
  return content_->root.find(key) != nullptr;
}

void SceneFile::read(const std::string& section, Presence presence,
                     const std::function<void(Fields&)>& describe, std::vector<Complaint>& complaints) const {
  const SceneEntry* found = content_->root.find(section);
  if (found) {
    SectionReader::read(found->value, {section, found->place}, describe, complaints);
  } else if (presence == Presence::required) {
    complaints.push_back(complaint(content_->root.place, section, "this section is missing"));
  }
}

void SceneFile::check_sections(const std::vector<std::string>& known,
                               std::vector<Complaint>& complaints) const {
  complaints.insert(complaints.end(), content_->complaints.begin(), content_->complaints.end());
  for (const auto& entry : content_->root.entries) {
    if (entry.key == "title" && entry.value.kind != SceneNode::Kind::scalar)
      complaints.push_back(
          complaint(entry.value.place, "title", "expects a text, got " + shown(entry.value)));
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string nearest = nearest_name(entry.key, known);
    const std::string hint =
        nearest.empty() ? "unknown section;" : fmt::format("unknown section; did you mean '{}'?", nearest);
    complaints.push_back(
        complaint(entry.place, entry.key, fmt::format("{} known: {}", hint, fmt::join(known, ", "))));
  }
}

namespace {

/// "particles.contacts[0].friction" as its steps: keys, and indices in brackets.
std::vector<std::string> steps_of(const std::string& key_path) {
  std::vector<std::string> steps;
  std::string step;
  for (const char c : key_path + ".") {
    if (c == '.' || c == '[') {
      if (!step.empty()) steps.push_back(step);
      step.clear();
    }
    if (c != '.') step += c;
  }
  return steps;
}

SceneNode& item_at(SceneNode& node, const std::string& step, const std::string& key_path) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data() + 1, step.data() + step.size(), index);
  const bool closed = step.back() == ']' && end == step.data() + step.size() - 1;
  if (error != std::errc{} || !closed || node.kind != SceneNode::Kind::list || index >= node.items.size())
    throw ConfigError(fmt::format("{}: there is no entry {} here to set", key_path, step));
  return node.items[index];
}

SceneNode parsed_value(const std::string& key_path, const std::string& value) {
  std::vector<Complaint> complaints;
  SceneNode root = parse_yaml("value: " + value, "setting of " + key_path, complaints);
  if (!complaints.empty() || root.entries.size() != 1)
    throw ConfigError(key_path + ": cannot be set to " + quoted(value));
  return std::move(root.entries.front().value);
}

}  // namespace

void SceneFile::set(const std::string& key_path, const std::string& value) {
  const auto steps = steps_of(key_path);
  if (steps.empty()) throw ConfigError("a key path is needed to set a value");
  const SceneNode replacement = parsed_value(key_path, value);
  const int rank = ++content_->rank;
  SceneNode* node = &content_->root;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (steps[i].front() == '[') {
      node = &item_at(*node, steps[i], key_path);
      continue;
    }
    if (node->kind != SceneNode::Kind::map)
      throw ConfigError(fmt::format("{}: '{}' stands in no map", key_path, steps[i]));
    SceneEntry* entry = node->find(steps[i]);
    if (!entry)
      entry = &node->entries.emplace_back(
          SceneEntry{steps[i], replacement.place, rank, {SceneNode::Kind::map, replacement.place}});
    entry->rank = rank;
    node = &entry->value;
  }
  if (steps.back().front() != '[' && node->kind != SceneNode::Kind::map)
    throw ConfigError(fmt::format("{}: '{}' stands in no map", key_path, steps.back()));
  if (steps.back().front() == '[') {
    item_at(*node, steps.back(), key_path) = replacement;
  } else {
    SceneNode over(SceneNode::Kind::map, node->place);
    over.entries.push_back({steps.back(), replacement.place, rank, replacement});
    *node = overlay(std::move(*node), over, rank);
  }
  spell_out_solvers(content_->root);
}

void log_warnings(std::vector<Complaint>& complaints) {
  std::erase_if(complaints, [](const Complaint& complaint) {
    if (complaint.warning) log_warning(complaint.text());
    return complaint.warning;
  });
}

bool SceneReader::has_complaints() const {
  return !std::ranges::all_of(complaints_, &Complaint::warning);
}

void SceneReader::finish() {
  file_.check_sections(known_, complaints_);
  log_warnings(complaints_);
  if (complaints_.empty()) return;
  std::stable_sort(complaints_.begin(), complaints_.end(), [](const Complaint& a, const Complaint& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  });
  throw ConfigError(std::move(complaints_));
}

}  // namespace talus::core
