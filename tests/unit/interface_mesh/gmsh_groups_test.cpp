#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/surface_checks.hpp"

using namespace talus;
using core::Vector3;

namespace {

const std::string field = std::string(TALUS_SOURCE_DIR) + "/tests/field/gmsh/";

mesh::Net parsed(const std::string& text) {
  std::istringstream stream(text);
  return mesh::parse_gmsh(stream, "net.msh");
}

std::string error_of(const std::string& text) {
  try {
    (void)parsed(text);
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

double upward_area(const mesh::Surface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3 p = mesh::point(surface.positions, a);
    sum += (mesh::point(surface.positions, b) - p).cross(mesh::point(surface.positions, c) - p).z() / 2;
  }
  return sum;
}

double length(const mesh::Surface& surface) {
  double sum = 0;
  for (const auto& [a, b] : surface.segments)
    sum += (mesh::point(surface.positions, a) - mesh::point(surface.positions, b)).norm();
  return sum;
}

/// Version 2.2, in which Gmsh writes an element once for each of its groups: triangle 1 in both, line 1 and
/// triangle 2 (the other way round) in group 3; group 3 is there for lines and for surfaces.
const std::string plain_file = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 3 "sheet"
2 4 "left half"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
9 5 5 5
$EndNodes
$Elements
6
1 15 2 0 9 9
2 1 2 3 7 1 2
3 2 2 3 1 1 2 3
4 2 2 4 1 2 3 1
5 2 4 3 1 1 1 1 3 4
6 15 2 8 2 2
$EndElements
)";

}  // namespace

TEST_CASE(
    "a rope is whole whether its group's number is signed, second in the list or of a partitioned mesh") {
  for (const std::string file : {"plain_rope", "signed_rope", "order97_rope", "partitioned"}) {
    INFO(file);
    const auto net = mesh::read_mesh_file(field + file + ".msh");
    const auto rope = mesh::extract_part(net, "rope");
    CHECK(rope.surface.segments.size() == 2);
    CHECK(length(rope.surface) == 2);
    REQUIRE(net.find_set("rope"));
    CHECK(net.find_set("rope")->nodes.size() == 3);
    CHECK(net.surface.segments.size() == 2);
  }
}

TEST_CASE("of overlapping groups each is whole, and the mesh has every element once") {
  for (const std::string file : {"signed_rope", "order97_rope"}) {
    const auto net = mesh::read_mesh_file(field + file + ".msh");
    CHECK(mesh::extract_part(net, "rope").surface.segments.size() == 2);
    CHECK(mesh::extract_part(net, "all wires").surface.segments.size() == 2);
    CHECK(net.surface.segments.size() == 2);
  }
}

TEST_CASE("a negative group number turns its triangles over") {
  const auto net = mesh::read_mesh_file(field + "tri_turned_tag.msh");
  CHECK(mesh::faults(net.surface).empty());
  CHECK(upward_area(net.surface) == 1);
  CHECK(upward_area(mesh::extract_part(net, "sheet").surface) == 1);
}

TEST_CASE("a group name that no column can have is refused with its line") {
  CHECK_THROWS_WITH(mesh::read_mesh_file(field + "col_comma.msh"),
                    Catch::Contains("col_comma.msh:6: the group's name \"rope, upper\" holds a comma"));
  CHECK_THAT(error_of(replaced(plain_file, "\"sheet\"", "\"a \"good\" sheet\"")),
             Catch::Contains("net.msh:6: the group's name") && Catch::Contains("quotation mark"));
}

TEST_CASE("an element of version 2.2 that is listed for each of its groups is one element of both") {
  const auto net = parsed(plain_file);
  CHECK(net.surface.node_count() == 4);
  CHECK(net.surface.triangles.size() == 2);
  CHECK(net.surface.segments.size() == 1);
  CHECK(upward_area(net.surface) == 1);
  CHECK(mesh::extract_part(net, "sheet").surface.triangles.size() == 2);
  CHECK(mesh::extract_part(net, "left half").surface.triangles.size() == 1);
  CHECK(net.find_set("left half")->nodes.size() == 3);
  CHECK(net.find_set("group_8")->nodes.size() == 1);
  CHECK_THAT(error_of(replaced(plain_file, "4 2 2 4 1 2 3 1", "4 2 2 3 1 2 3 1")),
             Catch::Contains("net.msh:22: an element is there twice: its nodes are those of line 21"));
  // In the other order of corners group 4 turns it over.
  const auto turned = parsed(replaced(plain_file, "4 2 2 4 1 2 3 1", "4 2 2 4 1 2 1 3"));
  CHECK(upward_area(turned.surface) == 1);
  CHECK(upward_area(mesh::extract_part(turned, "left half").surface) == -0.5);
}

TEST_CASE("groups of equal numbers in different dimensions are different groups, named or not") {
  const auto net = parsed(plain_file);
  CHECK(mesh::extract_part(net, "group_3").surface.segments.size() == 1);
  CHECK(mesh::extract_part(net, "group_3").surface.triangles.empty());
  CHECK(mesh::extract_part(net, "sheet").surface.segments.empty());
  const auto unnamed = parsed(replaced(plain_file, "2\n2 3 \"sheet\"\n", "1\n"));
  CHECK(mesh::extract_part(unnamed, "group_3_of_lines").surface.segments.size() == 1);
  CHECK(mesh::extract_part(unnamed, "group_3_of_surfaces").surface.triangles.size() == 2);
}

TEST_CASE("a Gmsh file reads the same with any line ends") {
  const auto expected = parsed(plain_file);
  std::string windows;
  for (const char c : plain_file) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(parsed(windows).surface == expected.surface);
  CHECK(parsed(windows).cell_sets == expected.cell_sets);
}

TEST_CASE("an element whose entity or node is not there is refused with its line") {
  std::ostringstream partitioned;
  partitioned << std::ifstream(field + "partitioned.msh").rdbuf();
  REQUIRE(error_of(partitioned.str()).empty());
  CHECK(error_of(replaced(partitioned.str(), "1 3 1 1\n1 1 2", "1 8 1 1\n1 1 2")) ==
        "net.msh:41: an element belongs to entity 8 of dimension 1, which is not in $Entities");
  CHECK_THAT(error_of(replaced(plain_file, "2 1 2 3 7 1 2", "2 1 2 3 7 1 8")),
             Catch::Contains("net.msh:20: an element names node 8, which is not there"));
}

TEST_CASE("lines that partitioning laid between its parts are no wires") {
  const std::string text = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 1 1 0 1 3 0
$EndEntities
$PartitionedEntities
2
0
0 1 2 0
5 2 1 2 1 2 0 0 0 1 1 0 0 0
2 2 1 1 1 0 0 0 1 1 0 1 3 0
3 2 1 1 2 0 0 0 1 1 0 0 0
$EndPartitionedEntities
$Nodes
1 4 1 4
2 2 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
3 3 1 3
1 5 1 1
1 1 3
2 2 2 1
2 1 2 3
2 3 2 1
3 1 3 4
$EndElements
)";
  const auto net = parsed(text);
  CHECK(net.surface.segments.empty());
  CHECK(mesh::extract_part(net, "group_3").surface.triangles.size() == 2);
}
