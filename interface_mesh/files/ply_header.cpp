#include "interface_mesh/files/ply_header.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace talus::mesh::ply {

namespace {

Type read_type(Scanner& text) {
  using enum Type;
  constexpr std::array<std::pair<std::string_view, Type>, 16> names{{{"char", int8},
                                                                     {"int8", int8},
                                                                     {"uchar", uint8},
                                                                     {"uint8", uint8},
                                                                     {"short", int16},
                                                                     {"int16", int16},
                                                                     {"ushort", uint16},
                                                                     {"uint16", uint16},
                                                                     {"int", int32},
                                                                     {"int32", int32},
                                                                     {"uint", uint32},
                                                                     {"uint32", uint32},
                                                                     {"float", float32},
                                                                     {"float32", float32},
                                                                     {"double", float64},
                                                                     {"float64", float64}}};
  const std::string_view word = text.word("a property's type");
  for (const auto& [name, type] : names)
    if (name == word) return type;
  text.fail(fmt::format("there is no property type '{}'", word));
}

Property read_property(Scanner& text) {
  Property property;
  property.is_list = text.rest().starts_with("list ");
  if (property.is_list) {
    (void)text.word();
    property.count_type = read_type(text);
    if (property.count_type == Type::float32 || property.count_type == Type::float64)
      text.fail("a list's length must be a whole number");
  }
  property.type = read_type(text);
  property.name = text.word("a property's name");
  return property;
}

Header::Format read_format(Scanner& text) {
  const std::string name(text.word("the format")), version(text.word("the version"));
  if (version != "1.0") text.fail(fmt::format("is of version {}, but only 1.0 is read", version));
  if (name == "ascii") return Header::Format::text;
  if (name == "binary_little_endian") return Header::Format::little_endian;
  if (name == "binary_big_endian") return Header::Format::big_endian;
  text.fail(fmt::format("there is no format '{}'; there are: ascii, binary_little_endian, binary_big_endian",
                        name));
}

Element read_element(Scanner& text) {
  Element element{.name = std::string(text.word("an element's name"))};
  element.count = text.integer("an element's count");
  if (element.count < 0) text.fail(fmt::format("an element's count is {}, which cannot be", element.count));
  return element;
}

}  // namespace

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::size_t Element::find(std::string_view name_of_it, std::string_view other_name) const {
  std::size_t place = 0;
  while (place < properties.size() && properties[place].name != name_of_it &&
         properties[place].name != other_name)
    ++place;
  return place;
}

Header read_header(Scanner& text) {
  if (!text.next_line() || text.word() != "ply") text.fail("a PLY file begins with the word 'ply'");
  Header header;
  bool format_seen = false;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "format") header.format = read_format(text), format_seen = true;
    if (keyword == "element") header.elements.push_back(read_element(text));
    if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property stands before the first element");
      header.elements.back().properties.push_back(read_property(text));
    }
    if (keyword != "end_header") continue;
    if (!format_seen) text.fail("the header names no format");
    return header;
  }
  text.fail("the file ends before 'end_header'");
}

}  // namespace talus::mesh::ply
