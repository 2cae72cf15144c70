#include "dem_solver/scene/height_grid.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>

#include "core/errors.hpp"

namespace talus::dem {

namespace {

/// Esri ASCII raster: header lines of a key and a value, then the rows of heights from north to south.
/// [Esri, "Esri ASCII raster format"; keys in any case; heights stand at the middles of cells]
class AsciiGrid {
 public:
  explicit AsciiGrid(const std::filesystem::path& path) : path_(path), file_(path) {
    if (!file_) fail("cannot be opened");
    read_header();
    read_heights();
  }

  mesh::Index columns() const { return columns_; }
  mesh::Index rows() const { return rows_; }
  double cell() const { return cell_; }
  core::Vector3 corner() const { return corner_; }
  /// Row 0 is the southernmost. NaN where the grid has no height.
  double height(mesh::Index column, mesh::Index row) const {
    return heights_[static_cast<std::size_t>(rows_ - 1 - row) * columns_ + column];
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::ConfigError(path_.string() + ": " + what);
  }

  void read_header() {
    std::map<std::string, double> header;
    while (std::isalpha((file_ >> std::ws).peek())) {
      std::string key;
      double value = 0;
      if (!(file_ >> key >> value)) fail("the header's `" + key + "` needs a number");
      std::ranges::transform(key, key.begin(), [](unsigned char c) { return std::tolower(c); });
      header[key] = value;
    }
    const auto number = [&](const char* key) {
      if (!header.contains(key)) fail(std::string("the header has no `") + key + "`");
      return header[key];
    };
    const auto count = [&](const char* key) {
      const double n = number(key);
      if (!(n >= 2 && n <= most_nodes) || n != std::floor(n))
        fail(std::string("`") + key + "` must be a whole number of at least 2, but is " + std::to_string(n));
      return static_cast<mesh::Index>(n);
    };
    columns_ = count("ncols");
    rows_ = count("nrows");
    if (static_cast<double>(columns_) * rows_ > most_nodes) fail("has more nodes than can be numbered");
    cell_ = number("cellsize");
    if (!(cell_ > 0)) fail("`cellsize` must be greater than 0");
    const auto first_middle = [&](const std::string& axis) {
      const std::string middle = axis + "llcenter", corner = axis + "llcorner";
      return header.contains(middle) ? header[middle] : number(corner.c_str()) + 0.5 * cell_;
    };
    corner_ = {first_middle("x"), first_middle("y"), 0};
    if (header.contains("nodata_value")) missing_ = header["nodata_value"];
  }

  void read_heights() {
    heights_.reserve(static_cast<std::size_t>(columns_) * rows_);
    for (double height = 0; file_ >> height;) heights_.push_back(height == missing_ ? std::nan("") : height);
    const std::size_t expected = static_cast<std::size_t>(columns_) * rows_;
    if (!file_.eof()) fail("height " + std::to_string(heights_.size() + 1) + " is not a number");
    if (heights_.size() != expected)
      fail("has " + std::to_string(heights_.size()) + " heights, but `ncols` times `nrows` is " +
           std::to_string(expected));
  }

  static constexpr double most_nodes = 1e9;

  std::filesystem::path path_;
  std::ifstream file_;
  mesh::Index columns_ = 0, rows_ = 0;
  double cell_ = 0;
  core::Vector3 corner_ = core::Vector3::Zero();  ///< the south-western node
  double missing_ = -9999;                        // where the header does not say
  std::vector<double> heights_;
};

/// Adds two triangles for each four neighbours with heights, in the grid's own numbers.
void add_triangles(const AsciiGrid& grid, mesh::Surface& surface) {
  for (mesh::Index row = 0; row + 1 < grid.rows(); ++row)
    for (mesh::Index column = 0; column + 1 < grid.columns(); ++column) {
      const mesh::Index a = row * grid.columns() + column, b = a + 1, d = a + grid.columns(), c = d + 1;
      const double rise_ac = std::abs(grid.height(column + 1, row + 1) - grid.height(column, row)),
                   rise_bd = std::abs(grid.height(column, row + 1) - grid.height(column + 1, row));
      if (std::isnan(rise_ac + rise_bd)) continue;
      if (rise_ac <= rise_bd)
        surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {b, c, d}});
    }
}

/// Adds the nodes that triangles have, and numbers them by themselves.
void add_nodes(const AsciiGrid& grid, const core::Vector3& origin, mesh::Surface& surface) {
  std::vector<mesh::Index> number(static_cast<std::size_t>(grid.columns()) * grid.rows(), -1);
  for (auto& triangle : surface.triangles)
    for (mesh::Index& node : triangle) {
      mesh::Index& own = number[node];
      if (own < 0) {
        own = surface.node_count();
        const mesh::Index column = node % grid.columns(), row = node / grid.columns();
        const core::Vector3 p =
            grid.corner() + core::Vector3(column * grid.cell(), row * grid.cell(), grid.height(column, row));
        const core::Vector3 q = p - origin;
        surface.positions.insert(surface.positions.end(), q.data(), q.data() + 3);
      }
      node = own;
    }
}

}  // namespace

void describe(core::Fields& fields, HeightGridScene& grid) {
  fields.required("path", grid.path,
                  {.help = "an Esri ASCII grid (.asc) in metres, from this file's folder"});
  fields.with_default("origin", grid.origin,
                      {.unit = "m", .help = "the point of the map where the scene's origin is"});
}

mesh::Surface height_grid(const HeightGridScene& scene) {
  const AsciiGrid grid(scene.path);
  mesh::Surface surface;
  add_triangles(grid, surface);
  if (surface.triangles.empty())
    throw core::ConfigError(scene.path.string() + ": has no four neighbours with heights");
  add_nodes(grid, scene.origin, surface);
  return surface;
}

}  // namespace talus::dem
