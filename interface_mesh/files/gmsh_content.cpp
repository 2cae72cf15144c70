#include "interface_mesh/files/gmsh_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace talus::mesh::gmsh {

namespace {

/// Sections are streams of words: where a line ends does not matter within them.
class Reader {
 public:
  explicit Reader(Scanner& text) : text_(text) {}

  Content read();

 private:
  std::string_view word(const char* what);
  Number integer(const char* what) { return text_.to_integer(word(what), what); }
  double real(const char* what) { return text_.to_real(word(what), what); }
  std::size_t count(const char* what);

  void read_section(const std::string& section);
  void end_section(const std::string& section);
  void read_format();
  void read_group_names();
  void read_entities();
  void read_partitioned_entities();
  std::vector<Number> read_groups();
  void skip_bounds();
  void read_nodes();
  void read_plain_nodes();
  void add_node(Number tag, const std::array<double, 3>& at);
  void read_elements();
  void read_plain_elements();
  std::size_t corners_of(Number kind) const;
  void read_corners(Element& element);
  void look_up_groups();

  Scanner& text_;
  Content content_;
  enum class Version { unknown, plain_2, blocks_4 } version_ = Version::unknown;
  bool entities_seen_ = false;
  std::map<Key, std::vector<Number>> groups_of_entity_;
  std::set<Key> cuts_;  ///< where partitions meet: no entities of the geometry
};

std::string_view Reader::word(const char* what) {
  while (true) {
    if (const auto found = text_.word(); !found.empty()) return found;
    if (!text_.next_line()) text_.fail(fmt::format("the file ends where {} is expected", what));
    if (text_.rest().starts_with("$End"))
      text_.fail(fmt::format("the section ends where {} is expected", what));
  }
}

/// A count of things that each take at least two characters of the file.
std::size_t Reader::count(const char* what) {
  const Number value = integer(what);
  if (value < 0 || value > Number{1} << 31) text_.fail(fmt::format("{} is {}, which cannot be", what, value));
  return static_cast<std::size_t>(value);
}

void Reader::end_section(const std::string& section) {
  while (text_.next_line())
    if (text_.rest() == "$End" + section) return;
  text_.fail(fmt::format("the file ends before $End{}", section));
}

void Reader::read_format() {
  const std::string version(word("the version"));
  const Number binary = integer("the file type");
  (void)integer("the size of a number");
  if (version != "4.1" && version != "2.2")
    text_.fail(fmt::format("is of version {}, but only 4.1 and 2.2 are read: save it as 'Version 4 ASCII'",
                           version));
  if (binary != 0) text_.fail("is binary, but only text is read: save it as 'Version 4 ASCII'");
  version_ = version == "2.2" ? Version::plain_2 : Version::blocks_4;
}

void Reader::read_group_names() {
  for (std::size_t left = count("the number of names"); left > 0; --left) {
    const Number dimension = integer("a group's dimension"), tag = integer("a group's number");
    const std::string_view quoted = text_.rest();
    if (quoted.size() < 3 || quoted.front() != '"' || quoted.back() != '"')
      text_.fail("a group's name is not in quotes or empty");
    const std::string name(quoted.substr(1, quoted.size() - 2));
    if (name.find_first_of(",\"") != std::string::npos)
      text_.fail(
          fmt::format("the group's name {} holds a comma or a quotation mark, which cannot stand in the "
                      "columns of result files: give the group another name",
                      quoted));
    if (!content_.group_names.emplace(Key{dimension, tag}, name).second)
      text_.fail(fmt::format("group {} of dimension {} is named twice", tag, dimension));
    text_.skip_line();
  }
}

std::vector<Number> Reader::read_groups() {
  std::vector<Number> groups;
  for (std::size_t left = count("the number of groups"); left > 0; --left)
    groups.push_back(integer("a group's number"));
  return groups;
}

void Reader::skip_bounds() {
  for (std::size_t left = count("the number of bounds"); left > 0; --left) (void)integer("a bound's number");
}

/// A point stands at three coordinates, anything else has a box.
int extent_numbers(Number dimension) {
  return dimension == 0 ? 3 : 6;
}

void Reader::read_entities() {
  entities_seen_ = true;
  std::array<std::size_t, 4> counts{};
  for (auto& each : counts) each = count("the number of entities");
  for (Number dimension = 0; dimension < 4; ++dimension)
    for (std::size_t left = counts[static_cast<std::size_t>(dimension)]; left > 0; --left) {
      const Key entity{dimension, integer("an entity's number")};
      for (int k = 0; k < extent_numbers(dimension); ++k) (void)real("an entity's extent");
      groups_of_entity_[entity] = read_groups();
      if (dimension > 0) skip_bounds();
    }
}

/// The pieces of entities in the parts of a mesh that was cut for several processes. A piece is in the groups
/// that list it, and in those of the entity it was cut from where it has that entity's dimension.
void Reader::read_partitioned_entities() {
  entities_seen_ = true;
  (void)count("the number of partitions");
  for (std::size_t left = count("the number of ghost entities"); left > 0; --left) {
    (void)integer("a ghost entity's number");
    (void)integer("a ghost entity's partition");
  }
  const auto whole = groups_of_entity_;
  std::array<std::size_t, 4> counts{};
  for (auto& each : counts) each = count("the number of entities");
  for (Number dimension = 0; dimension < 4; ++dimension)
    for (std::size_t left = counts[static_cast<std::size_t>(dimension)]; left > 0; --left) {
      const Key piece{dimension, integer("an entity's number")};
      const Number parent_dimension = integer("a parent's dimension");
      const Key parent{parent_dimension, integer("a parent's number")};
      for (std::size_t part = count("the number of partitions"); part > 0; --part)
        (void)integer("a partition's number");
      for (int k = 0; k < extent_numbers(dimension); ++k) (void)real("an entity's extent");
      auto groups = read_groups();
      const auto inherited = whole.find(parent);
      if (parent_dimension == dimension && inherited != whole.end())
        for (const Number group : inherited->second)
          if (std::none_of(groups.begin(), groups.end(),
                           [&](Number own) { return std::abs(own) == std::abs(group); }))
            groups.push_back(group);
      if (parent_dimension != dimension) cuts_.insert(piece);
      groups_of_entity_[piece] = std::move(groups);
      if (dimension > 0) skip_bounds();
    }
}

void Reader::add_node(Number tag, const std::array<double, 3>& at) {
  if (!content_.nodes.emplace(tag, at).second) text_.fail(fmt::format("node {} is there twice", tag));
  content_.node_order.push_back(tag);
}

void Reader::read_plain_nodes() {
  for (std::size_t left = count("the number of nodes"); left > 0; --left) {
    const Number tag = integer("a node's number");
    std::array<double, 3> at{};
    for (double& coordinate : at) coordinate = real("a node's coordinate");
    add_node(tag, at);
  }
}

void Reader::read_nodes() {
  std::size_t blocks = count("the number of node blocks");
  for (int k = 0; k < 3; ++k) (void)integer("a node count or number");
  for (; blocks > 0; --blocks) {
    const Number dimension = integer("a block's dimension");
    (void)integer("a block's entity");
    const bool parametric = integer("whether nodes have parameters") != 0;
    std::vector<Number> tags;
    for (std::size_t left = count("a block's node count"); left > 0; --left)
      tags.push_back(integer("a node's number"));
    for (const Number tag : tags) {
      std::array<double, 3> at{};
      for (double& coordinate : at) coordinate = real("a node's coordinate");
      for (Number k = 0; parametric && k < dimension; ++k) (void)real("a node's parameter");
      add_node(tag, at);
    }
  }
}

std::size_t Reader::corners_of(Number kind) const {
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
  text_.fail(fmt::format(
      "has elements of kind {}, but only points, lines, triangles and quadrangles of first order are read",
      kind));
}

void Reader::read_corners(Element& element) {
  for (std::size_t k = 0; k < element.corners; ++k) {
    element.nodes[k] = integer("an element's node");
    if (!content_.nodes.contains(element.nodes[k]))
      text_.fail(fmt::format("an element names node {}, which is not there", element.nodes[k]));
  }
  element.line = text_.line();
}

void Reader::read_elements() {
  std::size_t blocks = count("the number of element blocks");
  for (int k = 0; k < 3; ++k) (void)integer("an element count or number");
  for (; blocks > 0; --blocks) {
    const Number dimension = integer("a block's dimension"), entity = integer("a block's entity");
    const Number kind = integer("a block's element kind");
    const std::size_t corners = corners_of(kind);
    for (std::size_t left = count("a block's element count"); left > 0; --left) {
      (void)integer("an element's number");
      Element element{static_cast<ElementKind>(kind), {dimension, entity}, {}, corners};
      read_corners(element);
      content_.elements.push_back(std::move(element));
    }
  }
}

/// Version 2.2: each element with the numbers of its group (0: none), its entity and partitions.
void Reader::read_plain_elements() {
  for (std::size_t left = count("the number of elements"); left > 0; --left) {
    (void)integer("an element's number");
    const Number kind = integer("an element's kind");
    const std::size_t corners = corners_of(kind);
    Element element{static_cast<ElementKind>(kind),
                    {std::min<Number>(2, static_cast<Number>(corners) - 1), 0},
                    {},
                    corners};
    const std::size_t tags = count("an element's number of tags");
    for (std::size_t k = 0; k < tags; ++k) {
      const Number tag = integer("an element's tag");
      if (k == 0 && tag != 0) element.groups = {tag};
      if (k == 1) element.entity.second = tag;
    }
    read_corners(element);
    content_.elements.push_back(std::move(element));
  }
}

void Reader::read_section(const std::string& section) {
  const bool plain = version_ == Version::plain_2;
  if (section == "MeshFormat") read_format();
  if (version_ == Version::unknown) text_.fail("a Gmsh file starts with $MeshFormat");
  if (section == "PhysicalNames") read_group_names();
  if (section == "Entities") read_entities();
  if (section == "PartitionedEntities") read_partitioned_entities();
  if (section == "Nodes") plain ? read_plain_nodes() : read_nodes();
  if (section == "Elements") plain ? read_plain_elements() : read_elements();
}

/// Version 4.1: an element is in the groups of its entity.
void Reader::look_up_groups() {
  if (version_ != Version::blocks_4 || !entities_seen_) return;
  for (Element& element : content_.elements) {
    const auto found = groups_of_entity_.find(element.entity);
    if (found == groups_of_entity_.end())
      text_.fail_at(element.line,
                    fmt::format("an element belongs to entity {} of dimension {}, which is not in $Entities",
                                element.entity.second, element.entity.first));
    element.groups = found->second;
  }
  std::erase_if(content_.elements, [&](const Element& element) {
    return element.groups.empty() && cuts_.contains(element.entity);
  });
}

Content Reader::read() {
  while (text_.next_line()) {
    if (!text_.rest().starts_with('$'))
      text_.fail(fmt::format("a section such as $Nodes is expected, got '{}'", text_.rest()));
    const std::string section(text_.rest().substr(1));
    text_.skip_line();
    read_section(section);
    end_section(section);
  }
  if (content_.elements.empty()) text_.fail("the file has no elements");
  look_up_groups();
  merge_repeated_elements(text_, content_, version_ == Version::plain_2);
  return std::move(content_);
}

}  // namespace

Content read(Scanner& text) {
  return Reader(text).read();
}

}  // namespace talus::mesh::gmsh
