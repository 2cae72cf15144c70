#include "coupler/run/scene_difference.hpp"

#include <catch2/catch.hpp>

#include "tests/support/folder.hpp"

using namespace talus;
using namespace talus::coupler;

namespace {

SceneDifference between(const std::string& before, const std::string& now) {
  // As a restart does: the earlier scene comes out of a file's text.
  return difference(flat_scene(text_of(flattened(core::SceneFile::parse(before, "before.yaml")))),
                    flattened(core::SceneFile::parse(now, "now.yaml")));
}

std::vector<std::string> texts(const std::vector<ChangedKey>& keys) {
  std::vector<std::string> all;
  for (const auto& key : keys) all.push_back(key.text());
  return all;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a new state of a body is told apart from values that a run goes on with") {
  const auto different = between(
      "particles: {rocks: {block: {at: [0, 0, 1 m], velocity: [0, 0, 0]}}, materials: {c: {density: 2700}}}",
      "particles: {rocks: {block: {at: [0, 0, 2 m], velocity: [0, -25 m/s, 0]}}, materials: {c: {density: "
      "1350}}}");
  CHECK(texts(different.state) == Texts{"particles.rocks.block.at[2]: 2 m, in the checkpoint 1 m",
                                        "particles.rocks.block.velocity[1]: -25 m/s, in the checkpoint 0"});
  CHECK(texts(different.changed) == Texts{"particles.materials.c.density: 1350, in the checkpoint 2700"});
}

TEST_CASE("a body, a stream or initial velocities that are new are a new state") {
  const auto different =
      between("time: {end: 1}",
              "time: {end: 1}\nparticles: {spheres: {a: {at: [0, 0, 1], radius: 1}}, "
              "streams: {s: {low: [0, 0, 0]}}}\nstructure: {initial_velocities: [{part: net}]}");
  CHECK(different.state.size() == 3 + 3 + 1);
  CHECK(texts(different.changed) == Texts{"particles.spheres.a.radius: 1, new against the checkpoint"});
}

TEST_CASE("a structure that stands elsewhere is a new state") {
  const auto different =
      between("structure: {parts: {net: {square_net: {corner: [0, 0, 0]}, cable: {area: 1}}}}",
              "structure: {parts: {net: {square_net: {corner: [0, 0, 1 m]}, cable: {area: 2}}}}");
  CHECK(texts(different.state) ==
        Texts{"structure.parts.net.square_net.corner[2]: 1 m, in the checkpoint 0"});
  CHECK(texts(different.changed) == Texts{"structure.parts.net.cable.area: 2, in the checkpoint 1"});
}

TEST_CASE("another content of a file that the scene names is a change, although its key is not") {
  test::Folder folder("contents");
  folder.add("wall.obj", "v 0 0 0\n")
      .add("scene.yaml", "particles: {boundaries: {wall: {mesh_file: {path: wall.obj}}}}\n");
  const auto flat = [&] { return flattened(core::SceneFile::load(folder / "scene.yaml")); };
  const FlatScene before = flat_scene(text_of(flat()));
  CHECK(texts(difference(before, flat()).changed) == Texts{});
  folder.add("wall.obj", "v 0 0 1\n");
  const auto changed = difference(before, flat()).changed;
  REQUIRE(changed.size() == 1);
  CHECK(changed.front().key == "content of wall.obj");
}

TEST_CASE("the same values in other words, a later end and other outputs are no difference") {
  const auto different = between(
      "title: a\ntime: {end: 1 s, step: 50 us}\noutput: {every: 1 ms}\ncoupling: {checkpoint_every: 1 s}\n",
      "coupling: {checkpoint_every: 2 s, timeout: 5 s}\ntitle: b\ntime: {step: 0.05 ms, end: 2 s}\n");
  CHECK(different.state.empty());
  CHECK(texts(different.changed) == Texts{});
}

TEST_CASE("many changed keys are listed up to twenty and counted") {
  std::vector<ChangedKey> keys(25, {"a.b", "1", "2"});
  const std::string lines = lines_of(keys);
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 21);
  CHECK_THAT(lines, Catch::EndsWith("and 5 more"));
}
