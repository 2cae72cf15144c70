#include "interface_mesh/files/surface_readers.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/surface_checks.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

const std::string field = std::string(TALUS_SOURCE_DIR) + "/tests/field/";

mesh::Net obj(const std::string& text) {
  return mesh::read_obj(mesh::Scanner(text, "rock.obj"));
}
mesh::Net stl(const std::string& text) {
  return mesh::read_stl(mesh::Scanner(text, "rock.stl"));
}
mesh::Net ply(const std::string& text) {
  return mesh::read_ply(mesh::Scanner(text, "rock.ply"));
}

template <class Read>
std::string error_of(Read read, const std::string& text) {
  try {
    (void)read(text);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

Vector3 corner(const mesh::Surface& surface, std::size_t triangle, std::size_t k) {
  return mesh::point(surface.positions, surface.triangles[triangle][k]);
}

Vector3 area_vector(const mesh::Surface& surface) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    sum +=
        (corner(surface, k, 1) - corner(surface, k, 0)).cross(corner(surface, k, 2) - corner(surface, k, 0)) /
        2;
  return sum;
}

double volume(const mesh::Surface& surface) {
  double sum = 0;
  for (std::size_t k = 0; k < surface.triangles.size(); ++k)
    sum += corner(surface, k, 0).dot(corner(surface, k, 1).cross(corner(surface, k, 2))) / 6;
  return sum;
}

template <class Value>
std::string bytes_of(Value value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// A binary solid of the triangles whose corners are given one after the other.
std::string binary_solid(const std::string& header, const std::vector<Vector3>& corners) {
  std::string solid = header;
  solid.resize(80, ' ');
  solid += bytes_of(static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    solid += std::string(12, '\0');
    for (std::size_t c = k; c < k + 3; ++c)
      for (const double x : corners[c]) solid += bytes_of(static_cast<float>(x));
    solid += bytes_of(std::uint16_t{0x7fff});  // a colour, as some programs write there
  }
  return solid;
}

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

}  // namespace

TEST_CASE("a sheet in two solids, in two materials or in one object is the same sheet of four nodes") {
  const auto plain = mesh::read_mesh_file(field + "surfaces/plain.obj");
  for (const std::string name : {"usemtl.obj", "stl_two_solids.stl"}) {
    INFO(name);
    const auto net = mesh::read_mesh_file(field + "surfaces/" + name);
    CHECK(net.surface.node_count() == 4);
    CHECK(area_vector(net.surface) == area_vector(plain.surface));
    CHECK(mesh::faults(net.surface).empty());
  }
  CHECK(mesh::extract_part(mesh::read_mesh_file(field + "surfaces/usemtl.obj"), "sheet")
            .surface.triangles.size() == 2);
  CHECK(
      mesh::extract_part(mesh::read_mesh_file(field + "surfaces/usemtl.obj"), "y").surface.triangles.size() ==
      1);
  CHECK(mesh::extract_part(mesh::read_mesh_file(field + "surfaces/stl_two_solids.stl"), "b")
            .surface.node_count() == 3);
}

TEST_CASE("a cube whose faces have two materials is closed: its volume is 1") {
  const auto net = mesh::read_mesh_file(field + "surfaces/cube_two_materials.obj");
  CHECK(net.surface.node_count() == 8);
  CHECK(net.surface.triangles.size() == 12);
  CHECK(volume(net.surface) == Approx(1).epsilon(1e-15));
  CHECK(mesh::faults(net.surface).empty());
}

TEST_CASE("lines of a file are kept beside its faces") {
  const auto net = mesh::read_mesh_file(field + "surfaces/edges.ply");
  CHECK(net.surface.triangles.size() == 1);
  REQUIRE(net.surface.segments.size() == 2);
  CHECK(mesh::point(net.surface.positions, net.surface.segments[0][1]) == Vector3(1, 1, 0));
  const auto lines = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2 3/7\n");
  CHECK(lines.surface.triangles.size() == 1);
  CHECK(lines.surface.segments == std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}});
}

TEST_CASE("coordinates of a map keep all the digits that stand in the file") {
  const Vector3 expected(2600000.4, 1200000.123456, 1500.08);
  const std::string corners = "2600000.4 1200000.123456 1500.08";
  CHECK(mesh::point(obj("v " + corners + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").surface.positions, 0) == expected);
  CHECK(mesh::point(stl("solid\n" + replaced(facet, "0 0 0", corners) + "endsolid\n").surface.positions, 0) ==
        expected);
  for (const bool big : {false, true}) {
    std::string binary =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty double x\nproperty float64 y\nproperty double z\n"
        "property uchar red\nelement face 1\nproperty list uint8 int32 vertex_index\nend_header\n";
    for (const Vector3& at : {expected, Vector3(1, 0, 0), Vector3(0, 1, 0)}) {
      for (const double x : at) binary += bytes_of(x, big);
      binary += '\x0a';  // a colour that looks like the end of a line
    }
    binary += '\x03';
    for (const std::int32_t k : {0, 1, 2}) binary += bytes_of(k, big);
    CHECK(mesh::point(ply(binary).surface.positions, 0) == expected);
  }
}

TEST_CASE("nodes are joined where they are exactly equal, and not one unit in the last place further") {
  const double next = std::nextafter(1.0, 2.0);
  CHECK(obj("v 1 0 0\nv 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nf 1 3 2\nf 4 5 3\n").surface.node_count() == 4);
  CHECK(obj("v 1 0 0\nv 0 0 0\nv 0 1 0\nv 1.0000000000000002 0 0\nv 1 1 0\nf 1 3 2\nf 4 5 3\n")
            .surface.node_count() == 5);
  CHECK(next == 1.0000000000000002);
  CHECK(
      obj("v 0 0 0\nv -0 0 1e0\nv 0 1 0\nv -0.0 -0 +0\nv 0 -1 0\nf 1 2 3\nf 2 4 5\n").surface.node_count() ==
      4);
}

TEST_CASE("a triangle a billionth of the size of its neighbours is kept") {
  const auto net = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 4 2 3\nf 4 3 5\nf 1 4 5\n");
  CHECK(net.surface.node_count() == 5);
  CHECK(net.surface.triangles.size() == 3);
  CHECK(mesh::faults(net.surface).empty());
  CHECK(area_vector(net.surface).z() == Approx(0.5).epsilon(1e-15));
}

TEST_CASE("a degenerate triangle of a file is named, not dropped") {
  const auto found =
      mesh::faults(stl("solid\n" + facet + replaced(facet, "1 0 0", "0 0 0") + "endsolid\n").surface);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Catch::Contains("triangle 1") && Catch::Contains("has no area"));
}

TEST_CASE("line ends, a mark of the byte order, capitals and exponents do not change what an STL file says") {
  const std::string text = "solid a name, with a facet\n" + facet + "endsolid a name\n";
  const auto expected = stl(text).surface;
  CHECK(expected.parts[0].name == "a name, with a facet");
  for (const std::string& same :
       {replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), "\n\n  " + text, "\xEF\xBB\xBF" + text,
        replaced(replaced(text, "vertex", "  VERTEX\t"), "facet normal", "FACET Normal"),
        replaced(text, "vertex 1 0 0", "vertex +1.0E+00 0.e0 -0"),
        replaced(text, "endsolid a name\n", "endsolid")})
    CHECK(stl(same).surface == expected);
}

TEST_CASE("a binary STL is told by its length, even where its header begins with solid") {
  const std::vector<Vector3> one{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vector3> two{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const std::string header : {"made by a scanner", "solid of a CAD program"}) {
    const auto net = stl(binary_solid(header, one));
    CHECK(net.surface.triangles.size() == 1);
    CHECK(area_vector(net.surface) == Vector3(0, 0, 0.5));
    const auto both = stl(binary_solid(header, one) + binary_solid(header, two));
    CHECK(both.surface.node_count() == 4);
    CHECK(mesh::extract_part(both, "solid_2").surface.triangles.size() == 1);
  }
  std::string cut = binary_solid("a scanner", one);
  cut.pop_back();
  CHECK(error_of(stl, cut) ==
        "rock.stl:0: is no STL file, or was cut off: as a binary one it announces 1 triangles, "
        "which take 134 bytes, but it has 133");
  std::vector<Vector3> infinite = one;
  infinite[1].x() = std::numeric_limits<double>::infinity();
  CHECK_THAT(error_of(stl, binary_solid("x", infinite)), Catch::Contains("not finite"));
}

TEST_CASE("faces of an OBJ file name their vertices from the front, from the back, with normals or without") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  const auto expected = obj(vertices + "f 1 2 3\n").surface;
  for (const std::string face :
       {"f -3 -2 -1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f 1/1 2/1 3/1", "f 1 2 \\\n  3",
        "f 1 2 3 # the only one", "s off\nmtllib a b.mtl\nf\t1 2 3\r"})
    CHECK(obj(vertices + face + "\n").surface == expected);
  CHECK(obj("v 0 0 0 0.5 0.5 0.5\nv 1 0 0 1\nv 0 1 0 1 1 0 0\nf 1 2 3\n").surface == expected);
}

TEST_CASE(
    "an OBJ face that lists a vertex twice or crosses itself is refused, one with a corner too many is not") {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  CHECK(obj(square + "f 1 2 2 3\n").surface.triangles.size() == 1);
  CHECK(error_of(obj, square + "f 1 2 1 2\n") == "rock.obj:5: the face has no area");
  CHECK(error_of(obj, square + "f 1 3 2 4\n") == "rock.obj:5: the face has no area");
  CHECK(error_of(obj, square + "v 3 2 0\nf 1 2 4 3 5\n") == "rock.obj:6: the face crosses or touches itself");
}

TEST_CASE("polygons are cut into triangles that cover them and nothing else") {
  const auto area_of = [](const std::string& text) {
    const auto net = obj(text);
    double sum = 0;
    for (std::size_t k = 0; k < net.surface.triangles.size(); ++k) {
      const auto& s = net.surface;
      const double z = (corner(s, k, 1) - corner(s, k, 0)).cross(corner(s, k, 2) - corner(s, k, 0)).z() / 2;
      CHECK(z > 0);
      sum += z;
    }
    return sum;
  };
  // An arrow whose first diagonal lies outside, from each corner; an L; a pentagon with a corner on an edge.
  const std::string arrow = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n";
  for (const std::string face : {"f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"})
    CHECK(area_of(arrow + face + "\n") == Approx(4));
  CHECK(area_of("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n") == Approx(3));
  CHECK(area_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n") == Approx(4));
}

TEST_CASE("groups, objects and materials of an OBJ file overlap, and each is taken whole") {
  const auto net =
      obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
          "o my sheet\ng left all\nusemtl steel\nf 1 2 3\ng right all\nf 2 4 3\nusemtl stone\nl 1 4\n");
  CHECK(net.surface.parts.size() == 3);
  const auto count = [&](const std::string& name) {
    const auto part = mesh::extract_part(net, name).surface;
    return std::pair(part.triangles.size(), part.segments.size());
  };
  CHECK(count("my sheet") == std::pair<std::size_t, std::size_t>(2, 1));
  CHECK(count("all") == std::pair<std::size_t, std::size_t>(2, 1));
  CHECK(count("left") == std::pair<std::size_t, std::size_t>(1, 0));
  CHECK(count("steel") == std::pair<std::size_t, std::size_t>(2, 0));
  CHECK(count("stone") == std::pair<std::size_t, std::size_t>(0, 1));
  CHECK_THROWS_WITH(
      mesh::extract_part(net, "iron"),
      "there is no part 'iron' in the mesh; there are: my sheet, left, all, steel, right, stone");
}

TEST_CASE("an OBJ file that is not what it should be is refused with the line") {
  CHECK(error_of(obj, "") == "rock.obj:0: the file holds neither lines nor triangles");
  CHECK(error_of(obj, "v 1 2\n") == "rock.obj:1: the line ends where a vertex's coordinate is expected");
  CHECK(error_of(obj, "v 1,5 2 3\n") ==
        "rock.obj:1: a vertex's coordinate is '1,5', which is no number of its kind");
  CHECK(error_of(obj, "v 1 2 nan\n") == "rock.obj:1: a vertex's coordinate is not finite");
  CHECK_THAT(error_of(obj, "v 1 2 3 4 5\n"), Catch::Contains("rock.obj:1: a vertex has 5 numbers"));
  CHECK(error_of(obj, "v 0 0 0\n\nf 1 2 3\n") ==
        "rock.obj:3: names vertex 2, but 1 vertices stand before this line");
  CHECK(error_of(obj, "v 0 0 0\nf 0 1 1\n") ==
        "rock.obj:2: names vertex 0, but 1 vertices stand before this line");
  CHECK(error_of(obj, "v 0 0 0\nf -2 1 1\n") ==
        "rock.obj:2: names vertex -2, but 1 vertices stand before this line");
  CHECK(error_of(obj, "v 0 0 0\nf 1 1\n") == "rock.obj:2: a face has 2 vertices, but needs at least 3");
  CHECK_THAT(error_of(obj, "cstype bezier\n"), Catch::Contains("rock.obj:1: 'cstype' is not read"));
}

TEST_CASE(
    "a PLY file is read by its header: any properties, types and elements, text or binary, CRLF or LF") {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment made by hand\nelement material 1\nproperty uchar red\nelement vertex "
      "4\n"
      "property uchar red\nproperty double z\nproperty float x\nproperty double y\nelement face 2\nproperty "
      "float "
      "quality\nproperty list uint8 int32 vertex_indices\nproperty list uchar float texcoord\nend_header\n"
      "255\n1 0 0 0\n2 0 1e0 0\n3 0 1 1\n4 0.0 0 +1\n0.5 4 0 1 2 3 2 0.25 0.75\n0.5 3 2 1 0 0\n";
  const auto net = ply(text);
  CHECK(net.surface.node_count() == 4);
  CHECK(net.surface.triangles == std::vector<std::array<Index, 3>>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}});
  CHECK(mesh::point(net.surface.positions, 2) == Vector3(1, 1, 0));
  CHECK(ply(replaced(text, "\n", "\r\n")).surface == net.surface);
  std::string binary =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
      "property short z\r\nelement edge 1\r\nproperty uint vertex1\r\nproperty uint16 "
      "vertex2\r\nend_header\r\n";
  for (const float x : {0.5f, 1.0f, 2.0f})
    binary += bytes_of(x) + bytes_of(0.0f) + bytes_of(std::int16_t{-3});
  binary += bytes_of(std::uint32_t{2}) + bytes_of(std::uint16_t{0});
  const auto line = ply(binary).surface;
  REQUIRE(line.segments.size() == 1);
  CHECK(mesh::point(line.positions, line.segments[0][0]) == Vector3(2, 0, -3));
  CHECK(mesh::point(line.positions, line.segments[0][1]) == Vector3(0.5, 0, -3));
  CHECK(error_of(ply, binary.substr(0, binary.size() - 1)) ==
        "rock.ply:10: the file ends where vertex2 is expected (at byte 34 behind the header)");
  CHECK_THAT(error_of(ply, binary + "x"), Catch::Contains("goes on behind the elements"));
  CHECK(ply(replaced(text, "element material 1", "element nothing 9000000000000000000\nelement material 1"))
            .surface == net.surface);
}

TEST_CASE("a PLY file that is not what it should be is refused with the line") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  REQUIRE(error_of(ply, text).empty());
  CHECK(error_of(ply, "plyx") == "rock.ply:1: a PLY file begins with the word 'ply'");
  CHECK(error_of(ply, replaced(text, "3 0 1 2", "3 0 1 3")) ==
        "rock.ply:13: names vertex 3, but 3 vertices stand before it, numbered from 0");
  CHECK(error_of(ply, replaced(text, "3 0 1 2", "2 0 1")) == "rock.ply:13: face 0 has 2 vertices");
  CHECK(error_of(ply, replaced(text, "3 0 1 2", "3 0 1 2 2")) ==
        "rock.ply:13: the line of a face goes on with '2' where the header has no more properties");
  CHECK(error_of(ply, replaced(text, "3 0 1 2\n", "")) ==
        "rock.ply:12: the file ends where another face is expected");
  CHECK(error_of(ply, replaced(text, "float z", "float w")) ==
        "rock.ply:9: the header gives a vertex no property 'z'");
  CHECK(error_of(ply, replaced(text, "float z", "half z")) == "rock.ply:6: there is no property type 'half'");
  CHECK(error_of(ply, replaced(text, "vertex_indices", "corners")) ==
        "rock.ply:12: the header gives a face no property 'vertex_indices'");
  CHECK_THAT(error_of(ply, replaced(text, "element face", "element tristrips")),
             Catch::Contains("strips are not read"));
  CHECK_THAT(error_of(ply, text.substr(0, 40)), Catch::Contains("the file ends before 'end_header'"));
}

TEST_CASE("any prefix of a surface file gives a mesh or an error, never anything else") {
  const std::string binary = binary_solid("solid", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const std::string text = "solid a\n" + facet + "endsolid\n";
  const std::string polygons = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\\\nb\nf 1 2 3 -1\nl 1 3\n";
  const std::string list =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto try_all = [](const auto& read, const std::string& content) {
    for (std::size_t length = 0; length <= content.size(); ++length) {
      Index nodes = 0;
      try {
        nodes = read(content.substr(0, length)).surface.node_count();
      } catch (const core::ConfigError&) {
      }
      CHECK(nodes <= 4);
    }
  };
  try_all(stl, binary);
  try_all(stl, text);
  try_all(obj, polygons);
  try_all(ply, list);
}

TEST_CASE("triangles come back from STL, OBJ and PLY files bit for bit") {
  const auto original =
      obj("v 0.1 2600000.7 1e-9\nv 1 0 0.3333333333333333\nv 0 1 0\nv 7 7 -7\nf 1 2 3\nf 2 4 3\n");
  for (const std::string kind : {"stl", "obj", "ply"}) {
    const auto path =
        std::filesystem::temp_directory_path() / ("talus_bits_" + std::to_string(::getpid()) + "." + kind);
    mesh::write_mesh_file(original, path);
    const auto back = mesh::read_mesh_file(path);
    std::filesystem::remove(path);
    INFO(kind);
    CHECK(back.surface.positions == original.surface.positions);
    CHECK(back.surface.triangles == original.surface.triangles);
  }
}
