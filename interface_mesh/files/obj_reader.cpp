#include <fmt/format.h>

#include <algorithm>

#include "interface_mesh/files/cell_collector.hpp"
#include "interface_mesh/files/joined_nodes.hpp"
#include "interface_mesh/files/polygon_triangles.hpp"
#include "interface_mesh/files/surface_readers.hpp"

namespace talus::mesh {

namespace {

/// Statements that say nothing about where vertices are and what spans between them.
constexpr std::array passed_over{"vt",     "vn",         "vp",        "s",        "mg",       "mtllib",
                                 "usemap", "maplib",     "bevel",     "c_interp", "d_interp", "lod",
                                 "p",      "shadow_obj", "trace_obj", "ctech",    "stech"};

class ObjReader {
 public:
  explicit ObjReader(Scanner text) : text_(std::move(text)) {}

  Net read() {
    while (text_.next_line()) {
      while (text_.continue_line('\\')) {
      }
      text_.cut_comment('#');
      if (const std::string keyword(text_.word()); !keyword.empty()) obey(keyword);
    }
    if (cells_.empty()) text_.fail("the file holds neither lines nor triangles");
    return cells_.net(nodes_.take_positions());
  }

 private:
  void obey(const std::string& keyword) {
    if (keyword == "v") return read_vertex();
    if (keyword == "f" || keyword == "fo") return read_face();
    if (keyword == "l") return read_polyline();
    if (keyword == "o") return change(object_, {std::string(text_.rest())});
    if (keyword == "usemtl") return change(material_, {std::string(text_.rest())});
    if (keyword == "g") return change(groups_, words());
    if (std::find(passed_over.begin(), passed_over.end(), keyword) != passed_over.end()) return;
    text_.fail(fmt::format(
        "'{}' is not read: only vertices (v), faces (f) and lines (l) of straight edges are, in objects "
        "(o), groups (g) and materials (usemtl)",
        keyword));
  }

  std::vector<std::string> words() {
    std::vector<std::string> all;
    for (auto found = text_.word(); !found.empty(); found = text_.word()) all.emplace_back(found);
    return all;
  }

  /// Three coordinates; behind them a weight, a colour or both.
  void read_vertex() {
    core::Vector3 at;
    for (double& coordinate : at) coordinate = text_.real("a vertex's coordinate");
    const std::size_t more = words().size();
    if (more != 0 && more != 1 && more != 3 && more != 4)
      text_.fail(fmt::format(
          "a vertex has {} numbers, but three coordinates are expected, and behind them at most a "
          "weight and a colour",
          3 + more));
    vertices_.push_back(nodes_.number(at));
  }

  /// The vertex of "7", "7/1", "7//3" or "-1/-1/-1": from 1, or backwards from the last.
  Index read_corner(std::string_view text) const {
    const std::int64_t number = text_.to_integer(text.substr(0, text.find('/')), "a vertex's number");
    const auto count = static_cast<std::int64_t>(vertices_.size());
    const std::int64_t place = number < 0 ? count + number : number - 1;
    if (place < 0 || place >= count)
      text_.fail(fmt::format("names vertex {}, but {} vertices stand before this line", number, count));
    return vertices_[static_cast<std::size_t>(place)];
  }

  std::vector<Index> read_corners(std::size_t least, const char* kind) {
    std::vector<Index> corners;
    for (auto found = text_.word(); !found.empty(); found = text_.word())
      corners.push_back(read_corner(found));
    if (corners.size() < least)
      text_.fail(fmt::format("a {} has {} vertices, but needs at least {}", kind, corners.size(), least));
    return corners;
  }

  void read_face() {
    list();
    const auto corners = read_corners(3, "face");
    std::vector<core::Vector3> places;
    for (const Index node : corners) places.push_back(nodes_[node]);
    const CutPolygon cut = cut_polygon(places);
    if (!cut.fault.empty()) text_.fail("the face " + cut.fault);
    for (const auto& [a, b, c] : cut.triangles) cells_.add_triangle({corners[a], corners[b], corners[c]});
  }

  void read_polyline() {
    list();
    const auto corners = read_corners(2, "line");
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) cells_.add_line({corners[k], corners[k + 1]});
  }

  void change(std::vector<std::string>& names, std::vector<std::string> to) {
    std::erase(to, "");
    names = std::move(to);
    changed_ = true;
  }

  /// A name may stand for an object, a group and a material at the same time.
  void list() {
    if (!std::exchange(changed_, false)) return;
    std::vector<Listing> listings;
    for (const auto* names : {&object_, &groups_, &material_})
      for (const auto& name : *names)
        if (std::find(listings.begin(), listings.end(), Listing{name}) == listings.end())
          listings.push_back({name});
    cells_.list_in(listings);
  }

  Scanner text_;
  JoinedNodes nodes_;
  std::vector<Index> vertices_;  ///< the node of each
  std::vector<std::string> object_, groups_, material_;
  bool changed_ = false;
  CellCollector cells_;
};

}  // namespace

Net read_obj(Scanner text) {
  return ObjReader(std::move(text)).read();
}

}  // namespace talus::mesh
