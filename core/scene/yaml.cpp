#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "core/scene/tree.hpp"
#include "core/scene/yaml_hints.hpp"
#include "core/utf8.hpp"

namespace talus::core {
namespace {

constexpr std::size_t largest_text = 16u << 20;  // bytes
constexpr std::size_t largest_depth = 64;
constexpr std::size_t largest_count = 1000000;  // values, those repeated through aliases included

/// Reading cannot go on.
struct Stop {
  Place place;
  std::string message;
};

/// Builds the tree from the parser's events, which, unlike yaml-cpp's nodes, still know duplicate keys and
/// the place of keys.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::filesystem::path& file, std::vector<Complaint>& complaints)
      : file_(std::make_shared<const std::filesystem::path>(file)), complaints_(complaints) {}

  SceneNode take_root() { return std::move(root_).value_or(SceneNode{}); }
  Place whole_file() const { return {file_, 0, 0}; }
  Place place(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_)
      throw Stop{
          place(mark),
          "a second YAML document starts here; a scene is one document: put it into a file of its own"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add({SceneNode::Kind::null, place(mark)}, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    const bool null = tag != "!" && (value == "~" || value == "null" || value.empty());
    add({null ? SceneNode::Kind::null : SceneNode::Kind::scalar, place(mark), value}, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(SceneNode::Kind::list, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(SceneNode::Kind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    drop_duplicates(open_.back().node);
    close();
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end())
      throw Stop{place(mark), "an alias stands inside of what it names, and would loop"};
    if (open_.size() + found->second.depth > largest_depth) throw too_deep(mark);
    count(found->second.count, place(mark));
    attach(found->second.node);
  }

 private:
  struct Open {
    SceneNode node;
    YAML::anchor_t anchor = 0;
    std::size_t count_before = 0;
    std::size_t depth = 1;                             ///< of what it holds, itself included
    std::optional<std::pair<std::string, Place>> key;  ///< of the entry whose value comes next
  };
  struct Anchored {
    SceneNode node;
    std::size_t count, depth;
  };

  static Stop too_deep(Place where) {
    return {std::move(where), fmt::format("nested deeper than {} levels", largest_depth)};
  }
  Stop too_deep(const YAML::Mark& mark) const { return too_deep(place(mark)); }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      throw Stop{place(mark),
                 fmt::format("scenes use no YAML tags such as {}: write the value without", quoted(tag))};
  }
  void count(std::size_t more, const Place& where) {
    count_ += more;
    if (count_ > largest_count) throw Stop{where, fmt::format("holds more than {} values", largest_count)};
  }
  void open(SceneNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    if (open_.size() >= largest_depth) throw too_deep(mark);
    const Place where = place(mark);
    if (!open_.empty() && open_.back().node.kind == SceneNode::Kind::map && !open_.back().key)
      throw Stop{where, "a key must be a word, not a list or a map"};
    count(1, where);
    open_.push_back({.node = {kind, where}, .anchor = anchor, .count_before = count_ - 1, .key = {}});
  }
  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    if (done.anchor) anchored_[done.anchor] = {done.node, count_ - done.count_before, done.depth};
    if (!open_.empty()) open_.back().depth = std::max(open_.back().depth, done.depth + 1);
    attach(std::move(done.node));
  }
  void add(SceneNode node, YAML::anchor_t anchor) {
    count(1, node.place);
    if (anchor) anchored_[anchor] = {node, 1, 0};
    attach(std::move(node));
  }
  void attach(SceneNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == SceneNode::Kind::list) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.key) {
      if (node.kind != SceneNode::Kind::scalar)
        throw Stop{node.place, "a key must be a word, not " + shown(node)};
      if (node.scalar == "<<")
        throw Stop{node.place,
                   "merge keys are not read: write the keys out, or put them into a scene that this one "
                   "`extends`"};
      parent.key.emplace(std::move(node.scalar), node.place);
    } else {
      parent.node.entries.push_back({std::move(parent.key->first), parent.key->second, 0, std::move(node)});
      parent.key.reset();
    }
  }

  std::string open_path() const {
    std::string path;
    for (const auto& level : open_) {
      if (level.node.kind == SceneNode::Kind::list) path += fmt::format("[{}]", level.node.items.size());
      if (level.key) path += (path.empty() ? "" : ".") + level.key->first;
    }
    return path;
  }

  /// Keeps the first of each key.
  void drop_duplicates(SceneNode& map) {
    std::unordered_map<std::string, Place> first;
    const std::string path = open_path();
    std::erase_if(map.entries, [&](const SceneEntry& entry) {
      const auto [seen, is_new] = first.try_emplace(entry.key, entry.place);
      if (!is_new)
        complaints_.push_back(
            complaint(entry.place, path.empty() ? entry.key : path + "." + entry.key,
                      fmt::format("this key is given twice; first in line {}", seen->second.line)));
      return !is_new;
    });
  }

  std::shared_ptr<const std::filesystem::path> file_;
  std::vector<Complaint>& complaints_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Anchored> anchored_;
  std::optional<SceneNode> root_;
  std::size_t count_ = 0;
};

/// yaml-cpp's scanner holds every bracket that is still open before it tells of the first, so a file of
/// brackets has to be found beforehand. Brackets in quotes and comments count as well: more than 64 open ones
/// are no scene either way.
void check_brackets(const std::string& text, const Place& file) {
  std::size_t open = 0;
  Place here{file.file, 1, 0};
  for (const char c : text) {
    ++here.column;
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (open > largest_depth)
      throw Stop{here, fmt::format("more than {} brackets are open here", largest_depth)};
    if (c == '\n') here = {file.file, here.line + 1, 0};
  }
}

/// Names of other encodings would end the run later, where a result is written.
void check_encoding(const std::string& text, const Place& file) {
  const std::size_t good = utf8_length(text);
  if (good == text.size()) return;
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(good), '\n');
  const auto start = good == 0 ? std::string::npos : text.rfind('\n', good - 1);
  const std::size_t column = good - (start == std::string::npos ? 0 : start + 1);
  throw Stop{{file.file, static_cast<int>(line) + 1, static_cast<int>(column) + 1},
             fmt::format("the byte 0x{:02x} is no UTF-8 (Latin-1?): save the file as UTF-8",
                         static_cast<unsigned char>(text[good]))};
}

void check_text(const std::string& text, const Place& file) {
  if (text.size() > largest_text)
    throw Stop{file, fmt::format("is larger than {} MB, which no scene is", largest_text >> 20)};
  const auto is_blank = [](unsigned char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  if (std::all_of(text.begin(), text.end(), is_blank)) throw Stop{file, "is empty"};
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw Stop{file, "is UTF-16: save the file as UTF-8"};
  const auto is_control = [&](unsigned char c) { return (c < ' ' && !is_blank(c)) || c == 127; };
  const auto control = std::find_if(text.begin(), text.end(), is_control);
  if (control != text.end()) {
    const int line = 1 + static_cast<int>(std::count(text.begin(), control, '\n'));
    throw Stop{{file.file, line, 0}, "holds bytes that are no text"};
  }
  check_encoding(text, file);
  check_brackets(text, file);
}

void check_root(const SceneNode& root, const Place& file) {
  if (root.kind == SceneNode::Kind::null) throw Stop{file, "holds no keys, only comments or blanks"};
  if (root.kind != SceneNode::Kind::map)
    throw Stop{root.place, "is no scene: expects lines of 'key: value', found " + shown(root)};
}

Complaint syntax_complaint(const YAML::Exception& error, const std::string& text,
                           const TreeBuilder& builder) {
  if (error.mark.is_null()) return complaint(builder.whole_file(), {}, "is not YAML: " + error.msg);
  std::istringstream lines(text);
  std::string line, before;
  for (int i = 0; i <= error.mark.line; ++i) {
    before = line;
    std::getline(lines, line);
  }
  return complaint(builder.place(error.mark), {}, "is not YAML: " + error.msg + yaml_hint(line, before));
}

}  // namespace

SceneNode parse_yaml(const std::string& text, const std::filesystem::path& file,
                     std::vector<Complaint>& complaints) {
  TreeBuilder builder(file, complaints);
  try {
    check_text(text, builder.whole_file());
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) continue;
    SceneNode root = builder.take_root();
    check_root(root, builder.whole_file());
    return root;
  } catch (const Stop& stop) {
    complaints.push_back(complaint(stop.place, {}, stop.message));
  } catch (const YAML::Exception& error) {
    complaints.push_back(syntax_complaint(error, text, builder));
  }
  return {};
}

}  // namespace talus::core
