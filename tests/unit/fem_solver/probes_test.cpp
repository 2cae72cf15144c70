#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

// The node that stands for a probe's point.
namespace {

using namespace talus;
using namespace talus::fem;

/// What the first column of a probe at `at` watches, on a net of pitch 0.15 m beside a rope of one element of 10 m;
/// or why there is none.
std::string watched(const std::string& at, const std::string& part = "") {
  const std::string cable = "cable: {area: 1 cm^2, density: 8000, youngs_modulus: 100 GPa}";
  const std::string text =
      "time: {end: 1 s}\nstructure:\n  parts:\n"
      "    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 0.15}, " +
      cable + "}\n    rope: {polyline: {points: [[5, 0, 0], [5, 10, 0]]}, " + cable +
      "}\noutput: {probes: {point: {at: " + at + (part.empty() ? "" : ", part: " + part) + "}}}\n";
  try {
    Structure structure(read_structural_scene(core::SceneFile::parse(text, "scene.yaml")));
    return structure.output().description().probes.front().watches;
  } catch (const core::ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a probe says which node it watches and how far that is from its point") {
  using Catch::Contains;
  CHECK_THAT(watched("[1.5, 1.5, 0]"),
             Contains("of net at (1.5, 1.5, 0) m, ") && Contains("from the point asked for"));
  CHECK_THAT(watched("[1.52, 1.5, 0]"),
             Contains("of net at (1.5, 1.5, 0) m, 20 mm from the point asked for"));
  CHECK_THAT(watched("[1.575, 1.5, 0]"), Contains("75 mm from the point asked for"));
  CHECK_THAT(watched("[3, 3, 0.14]"), Contains("of net at (3, 3, 0) m, 140 mm from"));
}

TEST_CASE("a probe further from every node than the elements there are long is refused with the distance") {
  using Catch::Contains;
  CHECK_THAT(watched("[3, 3, 0.16]"),
             Contains("output.probes.point.at: no node is near: node ") &&
                 Contains("of net at (3, 3, 0) m, 160 mm from the point asked for") &&
                 Contains("longest element there has 150 mm"));
  CHECK_THAT(watched("[1500, 1500, 0]"), Contains("no node is near") && Contains("2111 m from"));
  CHECK_THAT(watched("[-1.5, 1.5, 0]"), Contains("no node is near"));  // a lost sign
}

TEST_CASE("the reach of a probe is that of the elements of its own part at the node") {
  using Catch::Contains;
  CHECK_THAT(watched("[5, 8, 0]"), Contains("of rope at (5, 10, 0) m, 2 m from"));  // within its one element
  CHECK_THAT(watched("[5, 8, 0]", "net"), Contains("no node is near") && Contains("of net at (3, 3, 0) m"));
  CHECK_THAT(watched("[1.5, 1.5, 0]", "rope"),
             Contains("of rope at (5, 0, 0) m"));  // as far as the rope is long
}
