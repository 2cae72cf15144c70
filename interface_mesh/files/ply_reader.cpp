#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "interface_mesh/files/cell_collector.hpp"
#include "interface_mesh/files/joined_nodes.hpp"
#include "interface_mesh/files/ply_header.hpp"
#include "interface_mesh/files/polygon_triangles.hpp"
#include "interface_mesh/files/surface_readers.hpp"

namespace talus::mesh {

namespace {

/// The values of one element, by property; one value where it is no list. All types fit a double exactly.
using PlyRow = std::vector<std::vector<double>>;

/// Reads the values behind the header, one by one.
class PlyValues {
 public:
  PlyValues(Scanner& text, ply::Header::Format format)
      : text_(text), format_(format), bytes_(text.after_line()), total_(bytes_.size()) {}

  void read_row(const ply::Element& element, PlyRow& row) {
    row.resize(element.properties.size());
    if (is_text() && !element.properties.empty() && !text_.next_line())
      fail(fmt::format("the file ends where another {} is expected", element.name));
    for (std::size_t k = 0; k < element.properties.size(); ++k) read_property(element.properties[k], row[k]);
    if (is_text() && !text_.rest().empty())
      fail(fmt::format("the line of a {} goes on with '{}' where the header has no more properties",
                       element.name, text_.rest()));
  }

  /// Anything but the end means that the header told another layout.
  void expect_end() {
    const bool more =
        is_text() ? text_.next_line() : bytes_.find_first_not_of("\r\n") != std::string_view::npos;
    if (more) fail("the file goes on behind the elements that its header announces");
  }

  [[noreturn]] void fail(const std::string& message) const {
    if (is_text()) text_.fail(message);
    text_.fail(fmt::format("{} (at byte {} behind the header)", message, total_ - bytes_.size()));
  }

 private:
  bool is_text() const { return format_ == ply::Header::Format::text; }

  void read_property(const ply::Property& property, std::vector<double>& values) {
    values.clear();
    double count = property.is_list ? read_value(property.count_type, "a list's length") : 1;
    if (count < 0) fail(fmt::format("a list's length is {}, which cannot be", count));
    for (; count > 0; --count) values.push_back(read_value(property.type, property.name.c_str()));
  }

  double read_value(ply::Type type, const char* what) {
    if (!is_text()) return read_binary(type, what);
    const bool real = type == ply::Type::float32 || type == ply::Type::float64;
    return real ? text_.real(what) : static_cast<double>(text_.integer(what));
  }

  double read_binary(ply::Type type, const char* what) {
    switch (type) {
      case ply::Type::int8:
        return taken<std::int8_t>(what);
      case ply::Type::uint8:
        return taken<std::uint8_t>(what);
      case ply::Type::int16:
        return taken<std::int16_t>(what);
      case ply::Type::uint16:
        return taken<std::uint16_t>(what);
      case ply::Type::int32:
        return taken<std::int32_t>(what);
      case ply::Type::uint32:
        return taken<std::uint32_t>(what);
      case ply::Type::float32:
        return taken<float>(what);
      case ply::Type::float64:
        break;
    }
    return taken<double>(what);
  }

  template <class Value>
  Value taken(const char* what) {
    if (bytes_.size() < sizeof(Value)) fail(fmt::format("the file ends where {} is expected", what));
    std::array<char, sizeof(Value)> in_order;
    std::copy_n(bytes_.begin(), sizeof(Value), in_order.begin());
    const bool as_here =
        (format_ == ply::Header::Format::little_endian) == (std::endian::native == std::endian::little);
    if (!as_here) std::reverse(in_order.begin(), in_order.end());
    bytes_.remove_prefix(sizeof(Value));
    return std::bit_cast<Value>(in_order);
  }

  Scanner& text_;
  ply::Header::Format format_;
  std::string_view bytes_;
  std::size_t total_;
};

class PlyReader {
 public:
  explicit PlyReader(Scanner& text)
      : text_(text), header_(ply::read_header(text)), values_(text, header_.format) {}

  Net read() {
    for (const ply::Element& element : header_.elements) read_element(element);
    values_.expect_end();
    if (cells_.empty()) text_.fail("the file holds neither lines nor triangles");
    return cells_.net(nodes_.take_positions());
  }

 private:
  void read_element(const ply::Element& element) {
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    if (element.name == "edge") return read_edges(element);
    if (element.name == "tristrips" && element.count > 0)
      text_.fail("triangle strips are not read: save the file with faces");
    if (element.properties.empty()) return;  // takes no place, whatever its count is
    for (std::int64_t k = 0; k < element.count; ++k) values_.read_row(element, row_);
  }

  std::size_t place_of(const ply::Element& element, std::string_view name, std::string_view other_name,
                       bool is_list) const {
    const std::size_t place = element.find(name, other_name);
    if (place == element.properties.size())
      text_.fail(fmt::format("the header gives a {} no property '{}'", element.name, name));
    if (element.properties[place].is_list != is_list)
      text_.fail(fmt::format("a {}'s property '{}' must be {}", element.name, name,
                             is_list ? "a list" : "one number"));
    return place;
  }

  void read_vertices(const ply::Element& element) {
    const std::array places{place_of(element, "x", "x", false), place_of(element, "y", "y", false),
                            place_of(element, "z", "z", false)};
    for (std::int64_t k = 0; k < element.count; ++k) {
      values_.read_row(element, row_);
      const core::Vector3 at(row_[places[0]][0], row_[places[1]][0], row_[places[2]][0]);
      if (!at.allFinite()) values_.fail(fmt::format("vertex {} is not finite", k));
      vertices_.push_back(nodes_.number(at));
    }
  }

  Index node(double number) const {
    if (!(number >= 0 && number < static_cast<double>(vertices_.size())) || number != std::floor(number))
      values_.fail(fmt::format("names vertex {}, but {} vertices stand before it, numbered from 0", number,
                               vertices_.size()));
    return vertices_[static_cast<std::size_t>(number)];
  }

  void read_faces(const ply::Element& element) {
    if (element.count == 0) return;
    const std::size_t place = place_of(element, "vertex_indices", "vertex_index", true);
    for (std::int64_t k = 0; k < element.count; ++k) {
      values_.read_row(element, row_);
      std::vector<Index> corners;
      std::vector<core::Vector3> places;
      for (const double number : row_[place]) {
        corners.push_back(node(number));
        places.push_back(nodes_[corners.back()]);
      }
      if (corners.size() < 3) values_.fail(fmt::format("face {} has {} vertices", k, corners.size()));
      const CutPolygon cut = cut_polygon(places);
      if (!cut.fault.empty()) values_.fail(fmt::format("face {} {}", k, cut.fault));
      for (const auto& [a, b, c] : cut.triangles) cells_.add_triangle({corners[a], corners[b], corners[c]});
    }
  }

  void read_edges(const ply::Element& element) {
    if (element.count == 0) return;
    const std::size_t from = place_of(element, "vertex1", "vertex1", false),
                      to = place_of(element, "vertex2", "vertex2", false);
    for (std::int64_t k = 0; k < element.count; ++k) {
      values_.read_row(element, row_);
      cells_.add_line({node(row_[from][0]), node(row_[to][0])});
    }
  }

  Scanner& text_;
  ply::Header header_;
  PlyValues values_;
  PlyRow row_;
  JoinedNodes nodes_;
  std::vector<Index> vertices_;  ///< the node of each
  CellCollector cells_;
};

}  // namespace

Net read_ply(Scanner text) {
  return PlyReader(text).read();
}

}  // namespace talus::mesh
