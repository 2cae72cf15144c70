#include "core/output/field_index.hpp"

#include <fmt/format.h>

#include <chrono>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "core/output/field_store.hpp"
#include "core/output/file.hpp"

namespace talus::core {
namespace {

using Clock = std::chrono::steady_clock;
using Attributes = std::vector<std::pair<const char*, std::string>>;

pugi::xml_node add(pugi::xml_node parent, const char* name, const Attributes& attributes) {
  pugi::xml_node node = parent.append_child(name);
  for (const auto& [key, value] : attributes) node.append_attribute(key) = value.c_str();
  return node;
}

const char* topology_name(CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      return "Polyvertex";
    case CellKind::segment:
      return "Polyline";
    case CellKind::triangle:
      return "Triangle";
  }
  return "";
}

/// An array of numbers of one frame.
struct FrameArray {
  std::string path;  ///< "net/position"
  std::int64_t rows = 0;
  int components = 1;
};

void add_frame_array(pugi::xml_node parent, const FrameArray& array, std::int64_t frame) {
  const std::string shape = fmt::format("{} {}", array.rows, array.components);
  add(parent, "DataItem",
      {{"Dimensions", shape}, {"Format", "HDF"}, {"NumberType", "Float"}, {"Precision", "8"}})
      .text()
      .set(fmt::format("fields.h5:/{}/{}", array.path, frame_name(frame)).c_str());
}

void add_topology(pugi::xml_node grid, const GroupDescription& group) {
  const int nodes = static_cast<int>(group.kind);
  Attributes attributes{{"TopologyType", topology_name(group.kind)},
                        {"NumberOfElements", std::to_string(group.cell_count())}};
  if (group.kind != CellKind::triangle) attributes.emplace_back("NodesPerElement", std::to_string(nodes));
  auto topology = add(grid, "Topology", attributes);
  const std::string shape = fmt::format("{} {}", group.cell_count(), nodes);
  add(topology, "DataItem",
      {{"Dimensions", shape}, {"Format", "HDF"}, {"NumberType", "Int"}, {"Precision", "8"}})
      .text()
      .set(("fields.h5:/" + group.name + "/cells").c_str());
}

const char* attribute_type(int components) {
  return components == 1 ? "Scalar" : components == 3 ? "Vector" : components == 6 ? "Tensor6" : "Matrix";
}

}  // namespace

struct FieldIndex::Document {
  std::filesystem::path path;
  std::vector<GroupDescription> groups;
  std::int64_t frames = 0;
  pugi::xml_document xml = {};
  pugi::xml_node series = {};
  Clock::time_point written = {};
  Clock::duration cost = {};

  void add_group(pugi::xml_node frame, const GroupDescription& group) {
    auto grid = add(frame, "Grid", {{"Name", group.name}, {"GridType", "Uniform"}});
    add_topology(grid, group);
    auto geometry = add(grid, "Geometry", {{"GeometryType", "XYZ"}});
    add_frame_array(geometry, {group.name + "/position", group.nodes, 3}, frames);
    for (const auto& field : group.fields) {
      const bool on_nodes = field.location == FieldLocation::node;
      auto attribute = add(grid, "Attribute",
                           {{"Name", field.unit.empty() ? field.name : field.name + " (" + field.unit + ")"},
                            {"AttributeType", attribute_type(field.components)},
                            {"Center", on_nodes ? "Node" : "Cell"}});
      add_frame_array(
          attribute,
          {group.name + "/" + field.name, on_nodes ? group.nodes : group.cell_count(), field.components},
          frames);
    }
  }
};

FieldIndex::FieldIndex(const std::filesystem::path& path, const std::vector<GroupDescription>& groups)
    : document_(new Document{.path = path, .groups = {}}) {
  for (const auto& group : groups) {
    if (group.nodes == 0 || group.cell_count() == 0) continue;
    document_->groups.push_back(group);
  }
  auto root = add(document_->xml, "Xdmf", {{"Version", "2.0"}});
  document_->series = add(root.append_child("Domain"), "Grid",
                          {{"Name", "talus"}, {"GridType", "Collection"}, {"CollectionType", "Temporal"}});
  write();                  // so that a kill leaves a file whatever the moment
  document_->written = {};  // and the first frame's is written at once
}

FieldIndex::~FieldIndex() = default;

void FieldIndex::add_frame(double time) {
  auto& d = *document_;
  auto frame = add(d.series, "Grid",
                   {{"Name", fmt::format("frame {}", d.frames)},
                    {"GridType", "Collection"},
                    {"CollectionType", "Spatial"}});
  add(frame, "Time", {{"Value", fmt::format("{}", time)}});
  for (const auto& group : d.groups) d.add_group(frame, group);
  ++d.frames;
  constexpr int least_pause = 20;  // times the cost of writing
  if (Clock::now() - d.written >= least_pause * d.cost) write();
}

void FieldIndex::write() {
  auto& d = *document_;
  const auto start = Clock::now();
  std::ostringstream text;
  d.xml.save(text, " ");
  replace_file(d.path, text.str());
  d.written = Clock::now();
  d.cost = d.written - start;
}

}  // namespace talus::core
