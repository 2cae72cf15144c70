#include "interface_mesh/files/mesh_file.hpp"

#include <unistd.h>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/net_patterns.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/scene/mesh_file.hpp"
#include "interface_mesh/surface_checks.hpp"
#include "interface_mesh/tubes.hpp"
#include "tests/support/scenes.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

/// A file of this test alone, gone with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name, const std::string& content = {})
      : path_(std::filesystem::temp_directory_path() / ("talus_" + std::to_string(::getpid()) + "_" + name)) {
    if (!content.empty()) std::ofstream(path_) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// As Gmsh writes it: a square of a quadrangle and a triangle with a rope along its lower edge, a named
/// corner, numbers that are neither dense nor ordered, and a node that nothing uses.
const std::string small_file = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
0 3 "anchor"
1 1 "lower rope"
2 2 "net"
$EndPhysicalNames
$Comments
Sections that are not known are passed over.
$EndComments
$Entities
1 1 1 0
7 0 0 0 1 3
4 0 0 0 2 0 0 1 1 2 7 7
9 0 0 0 2 1 0 1 2 1 4
$EndEntities
$Nodes
2 6 3 60
1 4 0 2
10
3
0 0 0
1 0 0
2 9 0 4
20
60
40
50
2 0 0
2 1 0
0 1 0
9 9 9
$EndNodes
$Elements
4 5 1 5
0 7 15 1
1 10
1 4 1 2
2 10 3
3 3 20
2 9 3 1
4 10 3 60 40
2 9 2 1
5 3 20 60
$EndElements
)";

std::string error_of(const std::string& text) {
  std::istringstream stream(text);
  try {
    (void)mesh::parse_gmsh(stream, "net.msh");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

double area(const mesh::Surface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3 p = mesh::point(surface.positions, a);
    sum += (mesh::point(surface.positions, b) - p).cross(mesh::point(surface.positions, c) - p).norm() / 2;
  }
  return sum;
}

mesh::Net chain_link() {
  return mesh::clip(
      lattice(mesh::RhombicPattern{.diagonals = {0.083, 0.143}, .wire_diameter = 0.003}),
      mesh::make_panel(mesh::Rectangle{Vector3(1, 2, 3), Vector3(1, 1, 0), Vector3::UnitZ(), 0.7, 0.5}));
}

}  // namespace

TEST_CASE("a Gmsh file's physical groups become parts and node sets") {
  std::istringstream stream(small_file);
  const auto net = mesh::parse_gmsh(stream, "net.msh");
  const auto& surface = net.surface;
  CHECK(surface.node_count() == 5);
  REQUIRE(surface.parts.size() == 2);
  CHECK(surface.parts[0].name == "lower rope");
  CHECK(surface.parts[0].segment_end == 2);
  CHECK(surface.parts[1].name == "net");
  CHECK(surface.parts[1].triangle_end == 3);
  CHECK(area(surface) == Approx(2));
  CHECK(mesh::faults(surface).empty());
  CHECK(mesh::point(surface.positions, surface.segments[1][1]) == Vector3(2, 0, 0));
  REQUIRE(net.find_set("anchor"));
  CHECK(net.find_set("anchor")->nodes == std::vector<Index>{0});
  CHECK(net.find_set("lower rope")->nodes == std::vector<Index>{0, 1, 2});
  CHECK(net.find_set("net")->nodes.size() == 5);
}

TEST_CASE("a Gmsh file that is not what it should be is refused with the line") {
  CHECK(error_of("") == "net.msh:0: the file has no elements");
  CHECK(error_of("v 0 0 0\n") == "net.msh:1: a section such as $Nodes is expected, got 'v 0 0 0'");
  CHECK(error_of(replaced(small_file, "4.1 0", "4 0"))
            .find("net.msh:2: is of version 4, but only 4.1 and 2.2 are read") == 0);
  CHECK(error_of(replaced(small_file, "4.1 0", "4.1 1")).find("net.msh:2: is binary") == 0);
  CHECK(error_of(replaced(small_file, "2 1 0\n0 1 0", "2 nan 0\n0 1 0")) ==
        "net.msh:32: a node's coordinate is not finite");
  CHECK(error_of(replaced(small_file, "2 1 0\n0 1 0", "2 x 0\n0 1 0")) ==
        "net.msh:32: a node's coordinate is 'x', which is no number of its kind");
  CHECK(error_of(replaced(small_file, "5 3 20 60\n", "5 3 20 61\n")) ==
        "net.msh:46: an element names node 61, which is not there");
  CHECK(error_of(replaced(small_file, "5 3 20 60\n", "")) ==
        "net.msh:46: the section ends where an element's number is expected");
  CHECK(error_of(replaced(small_file, "2 9 2 1", "2 9 9 1")).find("has elements of kind 9") !=
        std::string::npos);
  CHECK(error_of(replaced(small_file, "\n3\n0 0 0", "\n10\n0 0 0")) == "net.msh:25: node 10 is there twice");
  CHECK(error_of(replaced(small_file, "1 4 0 2\n", "1 4 0 -2\n")) ==
        "net.msh:21: a block's node count is -2, which cannot be");
  CHECK(error_of(small_file.substr(0, 200)).find("the file ends") != std::string::npos);
}

TEST_CASE("any prefix of a Gmsh file gives a mesh or an error, never anything else") {
  for (std::size_t length = 0; length < small_file.size(); ++length) {
    std::istringstream stream(small_file.substr(0, length));
    mesh::Net net;
    try {
      net = mesh::parse_gmsh(stream, "net.msh");
    } catch (const core::ConfigError&) {
    }
    CHECK(net.surface.node_count() <= 5);
  }
}

TEST_CASE("a generated net comes back from a Gmsh file bit for bit, with its parts and node sets") {
  auto net = chain_link();
  net.surface.parts[0].wire_radius = 0;  // which the format has no place for
  const TemporaryFile file("net.msh");
  mesh::write_mesh_file(net, file.path());
  const auto back = mesh::read_mesh_file(file.path());
  CHECK(back.surface.positions == net.surface.positions);
  CHECK(back.surface.segments == net.surface.segments);
  CHECK(back.surface.parts == net.surface.parts);
  for (const auto& set : net.node_sets) {
    if (set.nodes.empty()) continue;
    REQUIRE(back.find_set(set.name));
    CHECK(back.find_set(set.name)->nodes == set.nodes);
  }
}

TEST_CASE("tubes come back from STL, OBJ and PLY files with their area, corners at the same place joined") {
  mesh::Net tubes;
  tubes.surface = mesh::as_tubes(chain_link().surface, 6);
  std::set<std::array<double, 3>> distinct;
  for (Index node = 0; node < tubes.surface.node_count(); ++node) {
    const Vector3 at = mesh::point(tubes.surface.positions, node);
    distinct.insert({at.x(), at.y(), at.z()});
  }
  for (const std::string kind : {"stl", "obj", "ply"}) {
    INFO(kind);
    const TemporaryFile file("tubes." + kind);
    mesh::write_mesh_file(tubes, file.path());
    const auto back = mesh::read_mesh_file(file.path());
    CHECK(back.surface.triangles.size() == tubes.surface.triangles.size());
    CHECK(back.surface.node_count() == static_cast<Index>(distinct.size()));
    CHECK(area(back.surface) == area(tubes.surface));
  }
}

TEST_CASE("wires cannot be written to a file of triangles, nor a mesh to a file of unknown kind") {
  CHECK_THROWS_WITH(mesh::write_mesh_file(chain_link(), "x.stl"), Catch::Contains("take triangles only"));
  CHECK_THROWS_WITH(mesh::write_mesh_file(chain_link(), "x.vtk"),
                    Catch::Contains("must end in .msh, .stl, .obj or .ply"));
  CHECK_THROWS_AS(mesh::read_mesh_file("/no/such/file.stl"), core::ConfigError);
  const TemporaryFile broken("broken.stl", "solid x\nfacet normal 0 0");
  CHECK_THROWS_AS(mesh::read_mesh_file(broken.path()), core::ConfigError);
}

TEST_CASE("a scene takes one part of a file, in the file's unit of length") {
  const TemporaryFile file("small.msh", small_file);
  mesh::MeshFileScene scene;
  CHECK(test::complaints_about("section: {path: " + file.path().string() + ", unit: 1 mm, part: lower rope}",
                               scene) == "");
  const auto rope = mesh::generate(scene);
  CHECK(rope.surface.node_count() == 3);
  CHECK(rope.surface.triangles.empty());
  CHECK(mesh::point(rope.surface.positions, 2) == Vector3(0.002, 0, 0));
  CHECK(rope.find_set("anchor")->nodes == std::vector<Index>{0});
  scene.part = "upper rope";
  CHECK_THROWS_WITH(
      mesh::generate(scene),
      Catch::EndsWith("small.msh: there is no part 'upper rope' in the mesh; there are: lower rope, net"));
}
