#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "dem_solver/scene/start_check.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

// What is said about bodies that start inside of what they meet, before time 0.
using namespace talus;

namespace {

using Catch::Contains;
using Catch::StartsWith;

const std::string floor_plane = "planes: {floor: {material: wall, point: [0, 0, 0], normal: [0, 0, 1]}}";
const std::string floor_faces =
    "boundaries: {floor: {material: wall, nodes: {positions: [[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, "
    "0]], "
    "triangles: [0, 1, 2, 0, 2, 3]}}}";
const std::string wire =
    "boundaries: {line: {material: wall, wire_radius: 5 mm, nodes: {positions: [[-3, 0, 0], [3, 0, 0]], "
    "segments: "
    "[0, 1]}}}";
const std::string falling = "gravity: [0, 0, -9.81]";

std::string ball(const std::string& at, const std::string& more = "") {
  return "spheres: {ball: {material: rock, radius: 0.5, at: [" + at + "]" + more + "}}";
}

/// What is said about a scene of particles made of these sections; `net` is a surface that the structure publishes.
std::string said(const std::vector<std::string>& sections, const mesh::Surface& net = {},
                 const std::string& law = "hertz: {restitution: 1}") {
  std::string text =
      "particles:\n"
      "  materials: {rock: {density: 2500, youngs_modulus: 1e7, poissons_ratio: 0.25}, wall: "
      "{youngs_modulus: 1e20, "
      "poissons_ratio: 0.25}}\n"
      "  contacts: [{between: [rock, rock], " +
      law + "}, {between: [rock, wall], " + law + "}]\n";
  for (const std::string& section : sections) text += "  " + section + "\n";
  dem::ParticlesScene scene;
  REQUIRE(test::complaints_about(text, scene, "particles") == "");
  try {
    mesh::Surface surface = dem::make_surface(scene.boundaries);
    dem::append(surface, net);
    check_start(scene, dem::build_model(scene, surface, {.step = 1e-5}), surface);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

/// A plane of slope 1:10 as a height grid of 20 m by 20 m; its height at (x, y) is 100 + x/10.
std::string slope(const test::Folder& folder) {
  return "boundaries: {terrain: {material: wall, height_grid: {path: " + (folder / "slope.asc").string() +
         "}}}";
}
void write_slope(test::Folder& folder) {
  std::string text = "ncols 11\nnrows 11\nxllcenter 0\nyllcenter 0\ncellsize 2\n";
  for (int row = 0; row < 11; ++row)
    for (int column = 0; column < 11; ++column)
      text += std::to_string(100 + 0.2 * column) + (column < 10 ? " " : "\n");
  folder.add("slope.asc", text);
}

}  // namespace

TEST_CASE("A sphere in or under a plane is named with the plane and its depth") {
  CHECK_THAT(
      said({ball("0, 0, 0.3"), floor_plane}),
      StartsWith("particles.spheres.ball: starts inside of plane `floor`, by 200 mm, with the centre at (0, "
                 "0, 0.3) m; more than 10 mm"));
  CHECK_THAT(said({ball("0, 0, -2"), floor_plane}), Contains("inside of plane `floor`, by 2.5 m"));
  CHECK_THAT(said({ball("0, 0, 0.3"), floor_plane, falling}), Contains("inside of plane `floor`, by 200 mm"));
  CHECK_THAT(said({ball("0, 0, 9"), floor_plane,
                   "boundaries: {wall: {material: wall, nodes: {positions: [[0.3, -9, 0], [0.3, 9, 0], [0.3, "
                   "0, 20]], "
                   "triangles: [0, 1, 2]}}}"}),
             Contains("inside of a face of `wall`, by 200 mm"));
}

TEST_CASE("A sphere in triangles, or with its centre in a face or on a wire, is named with its depth") {
  CHECK_THAT(said({ball("0, 0, 0.3"), floor_faces}),
             Contains("starts inside of a face of `floor`, by 200 mm"));
  CHECK_THAT(said({ball("0, 0, -0.3"), floor_faces}),
             Contains("starts inside of a face of `floor`, by 200 mm"));
  CHECK_THAT(said({ball("0.2, 0.1, 0"), floor_faces}),
             Contains("starts inside of a face of `floor`, by 500 mm"));
  CHECK_THAT(said({ball("0, 0, 0"), wire}), Contains("starts inside of a wire of `line`, by 505 mm"));
  CHECK_THAT(said({ball("0, 0.3, 0.3"), wire}), Contains("starts inside of a wire of `line`, by 80.74 mm"));
  CHECK_THAT(said({ball("3.4, 0, 0"), wire}), Contains("by 105 mm"));  // its end
}

TEST_CASE("A sphere below terrain is named although it touches nothing") {
  test::Folder folder("start_check");
  write_slope(folder);
  CHECK_THAT(said({ball("10, 10, 99"), slope(folder)}),
             Contains("starts below a face of `terrain`, by 2.5 m"));
  CHECK_THAT(said({ball("10, 10, -999"), slope(folder), floor_plane}), Contains("below a face of `terrain`"));
  CHECK_THAT(said({ball("10, 10, 101.3"), slope(folder)}),
             Contains("inside of a face of `terrain`, by 201.5 mm"));
  CHECK(said({ball("10, 10, 102"), slope(folder)}) == "");
  CHECK(said({ball("30, 10, 99"), slope(folder)}) == "");  // beside the grid

  CHECK_THAT(said({ball("0, 0, -2"), floor_faces, falling}),
             Contains("starts below a face of `floor`, by 2.5 m"));
  CHECK_THAT(said({ball("0, 0, -0.3"), floor_faces, falling}),
             Contains("starts below a face of `floor`, by 800 mm"));
  CHECK_THAT(said({ball("0, 0, 2"), floor_faces, "gravity: [0, 0, 9.81]"}),
             Contains("below a face of `floor`"));
}

TEST_CASE("What may be on its way, or comes to rest somewhere, is not taken for lost below a roof") {
  const std::string ground = "planes: {ground: {material: wall, point: [0, 0, -9], normal: [0, 0, 1]}}";
  CHECK(said({ball("0, 0, -2"), floor_faces}) == "");                   // no gravity
  CHECK(said({ball("0, 0, -2"), floor_faces, falling, ground}) == "");  // falls on the ground
  CHECK(said({ball("0, 0, -2", ", velocity: [0, 0, 5]"), floor_faces, falling}) ==
        "");                                                    // flies up against it
  CHECK(said({ball("5, 0, -2"), floor_faces, falling}) == "");  // beside it
  CHECK(said({ball("0, 0, -2"), falling,
              "boundaries: {floor: {material: wall, velocity: [0, 0, -9], nodes: {positions: [[-3, -3, 0], "
              "[3, -3, 0], "
              "[0, 3, 0]], triangles: [0, 1, 2]}}}"}) == "");  // it comes down on the ball
  CHECK(
      said({ball("0, 0, 0"), falling,
            "boundaries: {fence: {material: wall, nodes: {positions: [[-1, -9, -9], [-1, 9, -9], [3, 0, 9]], "
            "triangles: [0, 1, 2]}}}"}) == "");  // a fence that leans over it
}

TEST_CASE("A rock in the floor is named as one, with the depth of its deepest sphere") {
  // The largest sphere in a block of edge 1 touches its faces.
  const std::string text =
      said({"rocks: {block: {material: rock, at: [0, 0, 0.2], block: {edge: 1 m}}}", floor_plane});
  CHECK_THAT(text, StartsWith("particles.rocks.block: starts inside of plane `floor`, by 300 mm"));
  CHECK(text.find('\n') == std::string::npos);
  CHECK_THAT(
      said({"rocks: {pair: {material: rock, at: [0, 0, 0.3], spheres: {centres: [[0, 0, 0], [1, 0, 0]], "
            "radii: [0.5, 0.5]}}}",
            floor_faces}),
      StartsWith("particles.rocks.pair: starts inside of a face of `floor`, by 200 mm"));
  CHECK(said({"rocks: {block: {material: rock, at: [0, 0, 0.51], block: {edge: 1 m}}}", floor_plane}) == "");
}

TEST_CASE("Of a stream whose box meets the floor, the spheres inside are counted once each") {
  // A column of four cells of edge 1, a sphere of radius 0.5 in each: two under the floor.
  const auto stream = [](const std::string& low, const std::string& high) {
    return "streams: {s: {material: rock, count: 4, radius: [0.5], low: [0, 0, " + low + "], high: [1, 1, " +
           high + "]}}";
  };
  CHECK_THAT(
      said({stream("-2", "2"), floor_plane}),
      StartsWith("particles.streams.s: 2 of its spheres start inside of plane `floor`, the deepest by 2 m"));
  // Centres at -1.25, -0.25, 0.75 and 1.75 m: one is in the faces, and it touches both of them on their diagonal.
  CHECK_THAT(
      said({stream("-1.75", "2.25"), floor_faces}),
      StartsWith(
          "particles.streams.s: 1 of its spheres start inside of a face of `floor`, the deepest by 250 mm"));
  CHECK(said({stream("0", "4"), floor_plane}) == "");
}

TEST_CASE("A boulder in the net of the structure is named, too") {
  mesh::Surface net;
  net.positions = {-1, 0, 0, 0, 0, 0, 1, 0, 0};
  net.segments = {{0, 1}, {1, 2}};
  net.parts = {{.name = "net", .material = "wall", .wire_radius = 0, .segment_end = 2}};
  CHECK_THAT(said({ball("0, 0, 0.4")}, net),
             StartsWith("particles.spheres.ball: starts inside of a wire of `net`, by 100 mm"));
  CHECK(said({ball("0, 0, 0.501")}, net) == "");
  CHECK_THAT(said({ball("0, 0, 0.4"), falling}, net), Contains("inside of a wire of `net`, by 100 mm"));
}

TEST_CASE("Every body and partner is told at once") {
  const std::string text =
      said({"spheres: {a: {material: rock, radius: 0.5, at: [0, 0, 0.3]}, b: {material: rock, "
            "radius: 0.5, at: [2, 0, 0.4]}}",
            floor_plane, floor_faces});
  for (const char* name : {"spheres.a: starts inside of plane", "spheres.b: starts inside of plane",
                           "spheres.a: starts inside of a face", "spheres.b: starts inside of a face"})
    CHECK_THAT(text, Contains(name));
}

TEST_CASE("A start at rest is allowed up to 2 % of the radius, or to where the contact bears the weight") {
  CHECK(said({ball("0, 0, 0.4901"), floor_plane}) == "");
  CHECK_THAT(said({ball("0, 0, 0.4899"), floor_plane}),
             Contains("by 10.1 mm") && Contains("more than 10 mm"));
  // 1309 kg at 9.81 m/s^2 on 4e5 N/m: sinks by 32.1 mm.
  const std::string soft = "linear: {stiffness: 4e5, restitution: 1}";
  CHECK(said({ball("0, 0, 0.469"), floor_plane, falling}, {}, soft) == "");
  CHECK_THAT(said({ball("0, 0, 0.467"), floor_plane, falling}, {}, soft), Contains("more than 32.1 mm"));
  CHECK_THAT(said({ball("0, 0, 0.469"), floor_plane}, {}, soft), Contains("more than 10 mm"));
  // Nothing is so soft that it may start more than a tenth of its radius inside.
  CHECK_THAT(said({ball("0, 0, 0.44"), floor_plane, falling}, {}, "linear: {stiffness: 1e4, restitution: 1}"),
             Contains("more than 50 mm"));
}

TEST_CASE("Spheres that overlap each other are named") {
  CHECK_THAT(
      said({"spheres: {a: {material: rock, radius: 0.5, at: [0, 0, 0]}, b: {material: rock, radius: 0.5, at: "
            "[0.8, 0, 0]}}"}),
      Contains("the deepest by 0.2 m") && Contains("particles.spheres.a at (0, 0, 0) m") &&
          Contains("particles.spheres.b at (0.8, 0, 0) m"));
}
