#pragma once

#include <string>
#include <vector>

#include "interface_mesh/files/scanner.hpp"

/// What a PLY file says of its own layout (G. Turk, The PLY polygon file format, 1994).
namespace talus::mesh::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(Type type);

struct Property {
  std::string name;
  Type type = Type::float32;  ///< of its value or of each value of its list
  bool is_list = false;
  Type count_type = Type::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties{};

  /// The place of the property with one of these names among its own; the number of properties if there is
  /// none.
  std::size_t find(std::string_view name, std::string_view other_name) const;
};

struct Header {
  enum class Format { text, little_endian, big_endian } format = Format::text;
  std::vector<Element> elements;
};

/// Leaves the text at the header's last line. @throws core::ConfigError "FILE:LINE: ..."
Header read_header(Scanner& text);

}  // namespace talus::mesh::ply
