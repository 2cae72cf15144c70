// One mesh file, many parts.
#include <catch2/catch.hpp>

#include "core/program/log.hpp"
#include "tests/support/folder.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

using namespace talus::fem;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace {

/// Two posts, a rope over their heads, a wire that hangs from it, and a piece of ground.
const std::string barrier_file = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
0 1 "anchors"
1 2 "posts"
1 3 "rope"
1 4 "wire"
2 5 "ground"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 0 0 1
3 1 0 1
4 2 0 1
5 2 0 0
6 1 0 0.5
7 0 0 -1
8 1 0 -1
9 0 1 -1
$EndNodes
$Elements
9
1 15 2 1 1 1
2 15 2 1 5 5
3 1 2 2 1 1 2
4 1 2 2 2 4 5
5 1 2 3 3 2 3
6 1 2 3 4 3 4
7 1 2 4 5 3 6
8 2 2 5 6 7 8 9
9 15 2 1 7 7
$EndElements
)";

const std::string parts =
    "  parts:\n"
    "    ropes: {group: {name: rope}, cable: {area: 1 cm^2, density: 7850, youngs_modulus: 100 GPa}}\n"
    "    posts: {group: {name: posts}, bar: {area: 10 cm^2, density: 7850, youngs_modulus: 200 GPa}}\n"
    "    wires: {group: {name: wire}, cable: {area: 1 mm^2, density: 7850, youngs_modulus: 100 GPa}}\n"
    "  supports: [{nodes: anchors, fix: xyz}, {nodes: ropes, fix: y}]\n";

std::string file_in(const Folder& folder) {
  return "  mesh_file: {path: " + (folder / "barrier.msh").string() + "}\n";
}

bool said(const std::string& warning) {
  for (const auto& each : talus::core::warnings_said())
    if (each.find(warning) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("groups of one mesh file are parts that share its nodes, and what no part uses is no node") {
  Folder folder("mesh_groups");
  folder.add("barrier.msh", barrier_file);
  const Structure structure(tests::scene(file_in(folder) + parts));
  const Model& model = structure.model();
  CHECK(model.nodes() == 6);  // none of the ground
  CHECK(model.node_sets.at("ropes") == std::vector<Index>{1, 2, 3});
  CHECK(model.node_sets.at("posts") == std::vector<Index>{0, 1, 3, 4});
  CHECK(model.node_sets.at("wires") == std::vector<Index>{2, 5});
  CHECK(model.node_sets.at("anchors") == std::vector<Index>{0, 4});  // the third is on the ground
  CHECK(model.node_sets.at("wire") == model.node_sets.at("wires"));
  CHECK_FALSE(model.node_sets.contains("ground"));
  CHECK(said("no part takes elements of these groups: ground (1 of 1)"));
}

TEST_CASE("weld joins a group's nodes with those of other parts") {
  Folder folder("mesh_groups");
  folder.add("barrier.msh", barrier_file);
  const std::string stay =
      "    stay: {polyline: {points: [[0, 0, 1], [-1, 0, 0]]}, cable: {area: 1 cm^2, density: 7850, "
      "youngs_modulus: "
      "100 GPa}}\n";
  const std::size_t supports = parts.find("  supports");
  const Structure structure(tests::scene(file_in(folder) + "  weld: {tolerance: 1 mm}\n" +
                                         parts.substr(0, supports) + stay + parts.substr(supports)));
  const Model& model = structure.model();
  CHECK(model.nodes() == 7);  // the stay brings one
  CHECK(model.node_sets.at("stay.start") == std::vector<Index>{1});
}

TEST_CASE("what is wrong with a structure from a mesh file is told with what there is") {
  Folder folder("mesh_groups");
  folder.add("barrier.msh", barrier_file);
  const std::string file = file_in(folder), bar = ", bar: {area: 1, density: 1, youngs_modulus: 1}}\n";
  CHECK_THAT(
      tests::complaint(file + "  parts:\n    p: {group: {name: post}" + bar),
      Contains("barrier.msh: there is no part 'post' in the mesh; there are: posts, rope, wire, ground"));
  CHECK_THAT(tests::complaint(file + "  parts:\n    rope: {group: {name: posts}" + bar),
             Contains("structure.parts.rope") && Contains("has a group of this name"));
  CHECK_THAT(tests::complaint("  parts:\n    p: {group: {name: posts}" + bar),
             Contains("structure.parts") && Contains("needs `structure.mesh_file`"));
  CHECK_THAT(tests::complaint(file + "  parts:\n    p: {polyline: {points: [[0, 0, 0], [1, 0, 0]]}" + bar),
             Contains("structure.mesh_file") && Contains("taken by no part"));
}
