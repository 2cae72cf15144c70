#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"

namespace talus::mesh {

namespace {

using Number = std::int64_t;

/// Gmsh's numbers of element kinds.
enum ElementKind : Number { line = 1, triangle = 2, quadrangle = 3, single_point = 15 };

/// Words of a file with the line they stand on.
class Words {
 public:
  Words(std::istream& text, std::string name) : text_(text), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw core::ConfigError(fmt::format("{}:{}: {}", name_, line_, message));
  }

  /// Moves on to the next line that is not empty; false at the end of the file.
  bool next_line(std::string& content) {
    while (std::getline(text_, content)) {
      ++line_;
      while (!content.empty() && std::isspace(static_cast<unsigned char>(content.back()))) content.pop_back();
      if (!content.empty()) return true;
    }
    return false;
  }

  std::string word(const char* what) {
    std::string found;
    while (!(words_ >> found)) {
      std::string content;
      if (!next_line(content)) fail(fmt::format("the file ends where {} is expected", what));
      if (content.starts_with("$End")) fail(fmt::format("the section ends where {} is expected", what));
      words_ = std::istringstream(content);
    }
    return found;
  }

  Number integer(const char* what) { return parsed<Number>(what); }
  double real(const char* what) {
    const double value = parsed<double>(what);
    if (!std::isfinite(value)) fail(fmt::format("{} is not finite", what));
    return value;
  }
  /// A count of things that each take at least two characters of the file.
  std::size_t count(const char* what) {
    const Number value = integer(what);
    if (value < 0 || value > Number{1} << 31) fail(fmt::format("{} is {}, which cannot be", what, value));
    return static_cast<std::size_t>(value);
  }

  /// The rest of the present line, e.g. a quoted name.
  std::string rest() {
    std::string content;
    std::getline(words_, content);
    return content;
  }

  void end_section(const std::string& section) {
    std::string content;
    while (next_line(content))
      if (content == "$End" + section) {
        words_ = std::istringstream();
        return;
      }
    fail(fmt::format("the file ends before $End{}", section));
  }

 private:
  template <class T>
  T parsed(const char* what) {
    const std::string text = word(what);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("{} is '{}', which is no number of its kind", what, text));
    return value;
  }

  std::istream& text_;
  std::string name_;
  std::istringstream words_;
  int line_ = 0;
};

/// A geometric entity or a physical group: its dimension and number.
using Key = std::pair<Number, Number>;

struct Cell {
  ElementKind kind;
  Key entity;
  std::array<Number, 4> nodes{};
  std::size_t corners = 0;
};

/// The file's content, with its own numbers.
struct Content {
  std::map<Key, std::string> group_names;
  std::vector<Key> groups;  ///< in the order they are used by entities
  std::map<Key, std::vector<Number>> groups_of_entity;
  std::unordered_map<Number, std::array<double, 3>> nodes;
  std::vector<Number> node_order;
  std::vector<Cell> cells;
};

void read_format(Words& words) {
  const std::string version = words.word("the version");
  const Number binary = words.integer("the file type");
  (void)words.integer("the size of a number");
  if (version != "4.1")
    words.fail(fmt::format("is of version {}, but only 4.1 is read: save it as 'Version 4 ASCII'", version));
  if (binary != 0) words.fail("is binary, but only text is read: save it as 'Version 4 ASCII'");
}

void read_physical_names(Words& words, Content& content) {
  for (std::size_t left = words.count("the number of names"); left > 0; --left) {
    const Number dimension = words.integer("a group's dimension"), tag = words.integer("a group's number");
    std::string quoted = words.word("a group's name");
    quoted += words.rest();
    if (quoted.size() < 3 || quoted.front() != '"' || quoted.back() != '"')
      words.fail("a group's name is not in quotes or empty");
    content.group_names[{dimension, tag}] = quoted.substr(1, quoted.size() - 2);
  }
}

void read_entities(Words& words, Content& content) {
  std::array<std::size_t, 4> counts{};
  for (auto& count : counts) count = words.count("the number of entities");
  for (Number dimension = 0; dimension < 4; ++dimension)
    for (std::size_t left = counts[static_cast<std::size_t>(dimension)]; left > 0; --left) {
      const Key entity{dimension, words.integer("an entity's number")};
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) (void)words.real("an entity's extent");
      auto& groups = content.groups_of_entity[entity];
      for (std::size_t group = words.count("the number of groups"); group > 0; --group)
        groups.push_back(words.integer("a group's number"));
      if (dimension == 0) continue;
      for (std::size_t bound = words.count("the number of bounds"); bound > 0; --bound)
        (void)words.integer("a bound's number");
    }
}

void read_nodes(Words& words, Content& content) {
  std::size_t blocks = words.count("the number of node blocks");
  for (int k = 0; k < 3; ++k) (void)words.integer("a node count or number");
  for (; blocks > 0; --blocks) {
    const Number dimension = words.integer("a block's dimension");
    (void)words.integer("a block's entity");
    const bool parametric = words.integer("whether nodes have parameters") != 0;
    const std::size_t count = words.count("a block's node count");
    std::vector<Number> tags;
    for (std::size_t k = 0; k < count; ++k) tags.push_back(words.integer("a node's number"));
    for (const Number tag : tags) {
      std::array<double, 3> at{};
      for (double& coordinate : at) coordinate = words.real("a node's coordinate");
      for (Number k = 0; parametric && k < dimension; ++k) (void)words.real("a node's parameter");
      if (!content.nodes.emplace(tag, at).second) words.fail(fmt::format("node {} is there twice", tag));
      content.node_order.push_back(tag);
    }
  }
}

std::size_t corners_of(Words& words, Number kind) {
  switch (kind) {
    case single_point:
      return 1;
    case line:
      return 2;
    case triangle:
      return 3;
    case quadrangle:
      return 4;
    default:
      break;
  }
  words.fail(fmt::format(
      "has elements of kind {}, but only points, lines, triangles and quadrangles of first order are read",
      kind));
}

void read_elements(Words& words, Content& content) {
  std::size_t blocks = words.count("the number of element blocks");
  for (int k = 0; k < 3; ++k) (void)words.integer("an element count or number");
  for (; blocks > 0; --blocks) {
    const Number dimension = words.integer("a block's dimension"), entity = words.integer("a block's entity");
    const Number kind = words.integer("a block's element kind");
    const std::size_t corners = corners_of(words, kind);
    for (std::size_t left = words.count("a block's element count"); left > 0; --left) {
      (void)words.integer("an element's number");
      Cell cell{static_cast<ElementKind>(kind), {dimension, entity}, {}, corners};
      for (std::size_t k = 0; k < corners; ++k) {
        cell.nodes[k] = words.integer("an element's node");
        if (!content.nodes.contains(cell.nodes[k]))
          words.fail(fmt::format("an element names node {}, which is not there", cell.nodes[k]));
      }
      content.cells.push_back(cell);
    }
  }
}

Content read_content(Words& words) {
  Content content;
  std::string heading;
  bool format_seen = false;
  while (words.next_line(heading)) {
    if (!heading.starts_with('$'))
      words.fail(fmt::format("a section such as $Nodes is expected, got '{}'", heading));
    const std::string section = heading.substr(1);
    if (section == "MeshFormat") read_format(words), format_seen = true;
    if (!format_seen) words.fail("a Gmsh file starts with $MeshFormat");
    if (section == "PhysicalNames") read_physical_names(words, content);
    if (section == "Entities") read_entities(words, content);
    if (section == "Nodes") read_nodes(words, content);
    if (section == "Elements") read_elements(words, content);
    words.end_section(section);
  }
  if (content.cells.empty()) words.fail("the file has no elements");
  return content;
}

/// Gives the content the numbers of a surface.
class Assembly {
 public:
  explicit Assembly(const Content& content) : content_(content) {}

  Net net() {
    number_nodes();
    net_.node_sets.push_back({"nodes", {}});
    for (Index node = 0; node < net_.surface.node_count(); ++node) net_.node_sets[0].nodes.push_back(node);
    for (const auto& name : names_in_order()) add_part(name);
    add_groups();
    return std::move(net_);
  }

 private:
  std::vector<std::string> names_of(const Cell& cell) const {
    std::vector<std::string> names;
    const auto found = content_.groups_of_entity.find(cell.entity);
    if (found == content_.groups_of_entity.end()) return names;
    for (const Number tag : found->second) {
      const auto name = content_.group_names.find({cell.entity.first, tag});
      names.push_back(name != content_.group_names.end() ? name->second : fmt::format("group_{}", tag));
    }
    return names;
  }
  std::string part_of(const Cell& cell) const {
    const auto names = names_of(cell);
    return names.empty() ? "" : names.front();
  }

  void number_nodes() {
    std::set<Number> used;
    for (const auto& cell : content_.cells)
      used.insert(cell.nodes.begin(), cell.nodes.begin() + static_cast<std::ptrdiff_t>(cell.corners));
    for (const Number tag : content_.node_order) {
      if (!used.contains(tag)) continue;
      index_[tag] = net_.surface.node_count();
      const auto& at = content_.nodes.at(tag);
      net_.surface.positions.insert(net_.surface.positions.end(), at.begin(), at.end());
    }
  }

  std::vector<std::string> names_in_order() const {
    std::vector<std::string> names;
    for (const auto& cell : content_.cells)
      if (cell.kind != single_point)
        if (const auto name = part_of(cell); std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
    return names;
  }

  void add_part(const std::string& name) {
    Surface& surface = net_.surface;
    SurfacePart part{.name = name};
    part.segment_begin = static_cast<Index>(surface.segments.size());
    part.triangle_begin = static_cast<Index>(surface.triangles.size());
    for (const auto& cell : content_.cells) {
      if (cell.kind == single_point || part_of(cell) != name) continue;
      const auto node = [&](std::size_t k) { return index_.at(cell.nodes[k]); };
      if (cell.kind == line) surface.segments.push_back({node(0), node(1)});
      if (cell.kind != line) surface.triangles.push_back({node(0), node(1), node(2)});
      if (cell.kind == quadrangle) surface.triangles.push_back({node(0), node(2), node(3)});
    }
    part.segment_end = static_cast<Index>(surface.segments.size());
    part.triangle_end = static_cast<Index>(surface.triangles.size());
    surface.parts.push_back(std::move(part));
  }

  /// Each group's nodes in the order its elements name them.
  void add_groups() {
    std::map<std::string, std::set<Index>> seen;
    for (const auto& cell : content_.cells)
      for (const auto& name : names_of(cell))
        for (std::size_t k = 0; k < cell.corners; ++k) {
          const Index node = index_.at(cell.nodes[k]);
          if (!seen[name].insert(node).second) continue;
          auto set = std::find_if(net_.node_sets.begin(), net_.node_sets.end(),
                                  [&](const NodeSet& s) { return s.name == name; });
          if (set == net_.node_sets.end()) set = net_.node_sets.insert(net_.node_sets.end(), {name, {}});
          set->nodes.push_back(node);
        }
  }

  const Content& content_;
  std::unordered_map<Number, Index> index_;
  Net net_;
};

}  // namespace

Net parse_gmsh(std::istream& text, const std::string& name) {
  Words words(text, name);
  const Content content = read_content(words);
  return Assembly(content).net();
}

Net read_gmsh(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw core::ConfigError(fmt::format("{}: cannot be opened", path.string()));
  return parse_gmsh(file, path.string());
}

}  // namespace talus::mesh
