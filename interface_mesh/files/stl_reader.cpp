#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "interface_mesh/files/cell_collector.hpp"
#include "interface_mesh/files/joined_nodes.hpp"
#include "interface_mesh/files/surface_readers.hpp"

namespace talus::mesh {

namespace {

constexpr std::size_t header_size = 80, count_size = 4, facet_size = 50, normal_size = 12;

template <class Value>
Value little_endian(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little);
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// Bytes of the binary solid that `bytes` begins with; 0 where it is longer than they are.
std::size_t solid_size(std::string_view bytes) {
  if (bytes.size() < header_size + count_size) return 0;
  const std::size_t size = header_size + count_size +
                           facet_size * little_endian<std::uint32_t>(bytes.substr(header_size, count_size));
  return size <= bytes.size() ? size : 0;
}

/// Text read as counts gives lengths no file has: its letters are above 2^29 in the count's place.
bool is_binary(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t size = solid_size(bytes);
    if (size == 0) return false;
    bytes.remove_prefix(size);
  }
  return true;
}

bool begins_with_word(std::string_view text, std::string_view lower_case) {
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  text.remove_prefix(first);
  return text.size() >= lower_case.size() &&
         std::equal(lower_case.begin(), lower_case.end(), text.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

class StlReader {
 public:
  explicit StlReader(Scanner text) : text_(std::move(text)) {}

  Net read() {
    if (is_binary(text_.content()))
      read_binary(text_.content());
    else if (begins_with_word(text_.after_line(), "solid"))
      read_text();
    else
      refuse();
    if (cells_.empty()) text_.fail("holds no triangles");
    return cells_.net(nodes_.take_positions());
  }

 private:
  [[noreturn]] void refuse() const {
    const std::string_view bytes = text_.content();
    if (bytes.size() < header_size + count_size)
      text_.fail("is no STL file: it neither begins with 'solid' nor has the 84 bytes of a binary header");
    text_.fail(fmt::format(
        "is no STL file, or was cut off: as a binary one it announces {} triangles, which take {} "
        "bytes, but it has {}",
        little_endian<std::uint32_t>(bytes.substr(header_size, count_size)),
        header_size + count_size +
            facet_size * little_endian<std::uint32_t>(bytes.substr(header_size, count_size)),
        bytes.size()));
  }

  void read_binary(std::string_view bytes) {
    for (int solid = 1; !bytes.empty(); ++solid) {
      const std::size_t size = solid_size(bytes);
      if (size < bytes.size() || solid > 1) cells_.list_in({{fmt::format("solid_{}", solid)}});
      for (std::size_t at = header_size + count_size; at < size; at += facet_size) {
        std::array<Index, 3> facet{};
        for (std::size_t corner = 0; corner < 3; ++corner)
          facet[corner] = nodes_.number(binary_corner(bytes.substr(at + normal_size + 12 * corner, 12)));
        cells_.add_triangle(facet);
      }
      bytes.remove_prefix(size);
    }
  }

  core::Vector3 binary_corner(std::string_view bytes) const {
    core::Vector3 corner;
    for (std::size_t axis = 0; axis < 3; ++axis)
      corner[static_cast<Eigen::Index>(axis)] = little_endian<float>(bytes.substr(4 * axis, 4));
    if (!corner.allFinite()) text_.fail("a corner's coordinate is not finite");
    return corner;
  }

  /// Words in any case; where lines end does not matter but behind a solid's name.
  void read_text() {
    while (text_.next_line()) {
      expect("solid");
      const std::string name(text_.rest());
      cells_.list_in(name.empty() ? std::vector<Listing>{} : std::vector<Listing>{{name}});
      text_.skip_line();
      while (next_word("'facet' or 'endsolid'") != "endsolid") read_facet();
      text_.skip_line();
    }
  }

  void read_facet() {
    if (word_ != "facet") text_.fail(fmt::format("'facet' or 'endsolid' is expected, got '{}'", word_));
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) (void)next_word("a normal's component");
    expect("outer");
    expect("loop");
    std::array<Index, 3> facet{};
    for (Index& node : facet) {
      expect("vertex");
      core::Vector3 corner;
      for (double& coordinate : corner)
        coordinate = text_.to_real(next_word("a corner's coordinate"), "a corner's coordinate");
      node = nodes_.number(corner);
    }
    expect("endloop");
    expect("endfacet");
    cells_.add_triangle(facet);
  }

  const std::string& next_word(const char* what) {
    std::string_view found = text_.word();
    while (found.empty()) {
      if (!text_.next_line()) text_.fail(fmt::format("the file ends where {} is expected", what));
      found = text_.word();
    }
    word_ = found;
    std::transform(word_.begin(), word_.end(), word_.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word_;
  }

  void expect(const char* word) {
    if (next_word(word) != word) text_.fail(fmt::format("'{}' is expected, got '{}'", word, word_));
  }

  Scanner text_;
  std::string word_;
  JoinedNodes nodes_;
  CellCollector cells_;
};

}  // namespace

Net read_stl(Scanner text) {
  return StlReader(std::move(text)).read();
}

}  // namespace talus::mesh
