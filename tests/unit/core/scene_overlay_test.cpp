#include <catch2/catch.hpp>
#include <variant>

#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

namespace talus {
namespace {

struct Weak {
  std::optional<std::int64_t> substeps;
};
void describe(core::Fields& fields, Weak& weak) {
  fields.optional("substeps", weak.substeps, {.help = "steps"});
}
struct Strong {
  double tolerance = 1e-6;
};
void describe(core::Fields& fields, Strong& strong) {
  fields.with_default("tolerance", strong.tolerance, {.help = "of the residual"});
}
struct Coupling {
  std::variant<Weak, Strong> scheme;
  double window = 0;
  std::vector<double> times;
};
void describe(core::Fields& fields, Coupling& coupling) {
  fields.one_of(coupling.scheme, {{"weak", "once a window"}, {"strong", "until it agrees"}});
  fields.with_default("window", coupling.window, {.unit = "s", .help = "window"});
  fields.with_default("times", coupling.times, {.unit = "s", .help = "times"});
}

class Folder : public test::Folder {
 public:
  Folder() : test::Folder("scene_overlay") {}
};

Coupling read(const core::SceneFile& file) {
  core::SceneReader reader(file, {"section", "extends"});
  auto coupling = reader.required<Coupling>("section");
  reader.finish();
  return coupling;
}
std::string error(const core::SceneFile& file) {
  try {
    read(file);
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return {};
}
std::string load_error(const std::filesystem::path& path) {
  try {
    core::SceneFile::load(path);
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return {};
}

}  // namespace

TEST_CASE("an overlay merges maps and replaces lists and scalars") {
  Folder folder;
  folder.add("base.yaml", "section: {weak: {substeps: 3}, window: 1 ms, times: [1, 2, 3]}")
      .add("scene.yaml", "extends: base.yaml\nsection: {window: 2 ms, times: [4]}");
  const auto coupling = read(core::SceneFile::load(folder / "scene.yaml"));
  CHECK(std::get<Weak>(coupling.scheme).substeps == 3);
  CHECK(coupling.window == 2e-3);
  CHECK(coupling.times == std::vector<double>{4});
}

TEST_CASE("another alternative of a choice in the overlay replaces that of the base") {
  Folder folder;
  folder.add("base.yaml", "section: {weak: {substeps: 3}}")
      .add("scene.yaml", "extends: base.yaml\nsection: {strong: {tolerance: 1e-3}}")
      .add("third.yaml", "extends: scene.yaml\nsection: {weak: {}}");
  CHECK(std::get<Strong>(read(core::SceneFile::load(folder / "scene.yaml")).scheme).tolerance == 1e-3);
  CHECK(std::get<Weak>(read(core::SceneFile::load(folder / "third.yaml")).scheme).substeps == 3);
}

TEST_CASE("two alternatives of a choice in one file contradict each other, none is too few") {
  const auto parse = [](const std::string& text) {
    return error(core::SceneFile::parse(text, "scene.yaml"));
  };
  CHECK(
      parse("section:\n  weak: {}\n  strong: {}\n") ==
      "scene.yaml:3:3: section.strong: contradicts 'weak' in line 2; only one of weak, strong may be given");
  CHECK(parse("section: {}\n") == "scene.yaml:1:1: section: needs one of the keys weak, strong");
}

TEST_CASE("a null in the overlay removes the key of the base") {
  Folder folder;
  folder.add("base.yaml", "section: {weak: {}, window: 1 ms}")
      .add("scene.yaml", "extends: base.yaml\nsection: {window: ~}");
  CHECK(read(core::SceneFile::load(folder / "scene.yaml")).window == 0);
}

TEST_CASE("complaints keep naming the file that the value came from") {
  Folder folder;
  folder.add("bases/base.yaml", "section: {weak: {}, window: 1 m}")
      .add("scene.yaml", "extends: bases/base.yaml\nsection: {times: [1 kg]}");
  CHECK(error(core::SceneFile::load(folder / "scene.yaml")) ==
        (folder / "bases/base.yaml").string() +
            ":1:29: section.window: expects a time such as '50 us', got '1 m'\n" +
            (folder / "scene.yaml").string() +
            ":2:19: section.times[0]: expects a time such as '50 us', got '1 kg'");
}

TEST_CASE("a path is relative to the file it was written in, which may be one that the scene extends") {
  Folder folder;
  folder.add("bases/base.yaml", "section: {mesh: net.msh, solver: old.py}")
      .add("scene.yaml", "extends: bases/base.yaml\nsection: {solver: new.py}");
  const auto file = core::SceneFile::load(folder / "scene.yaml");
  CHECK(file.path_at("section.mesh") == folder / "bases/net.msh");
  CHECK(file.path_at("section.solver") == folder / "new.py");
  CHECK(file.path_at("section.nothing").empty());
  CHECK(file.path_at("section").empty());
}

TEST_CASE(
    "the files that a scene names are found from the folders they are written in, and nothing else is") {
  Folder folder;
  folder.add("bases/net.msh", "")
      .add("own.obj", "")
      .add("unnamed.obj", "")
      .add("bases/base.yaml", "section: {mesh: net.msh, word: bases}");
  folder.add("scene.yaml", "extends: bases/base.yaml\nlist: [{file: own.obj}, own.obj, none.obj, 3]");
  const auto files = core::SceneFile::load(folder / "scene.yaml").named_files();
  CHECK(files == std::vector<std::filesystem::path>{folder / "bases/net.msh", folder / "own.obj"});
}

TEST_CASE("a scene that extends itself, a missing base and a base that is no path are errors at the key") {
  Folder folder;
  folder.add("a.yaml", "extends: b.yaml")
      .add("b.yaml", "extends: a.yaml")
      .add("c.yaml", "extends: none.yaml")
      .add("d.yaml", "extends: [1]");
  CHECK(load_error(folder / "a.yaml") == (folder / "b.yaml").string() +
                                             ":1:10: extends: extends itself, through '" +
                                             (folder / "a.yaml").string() + "'");
  CHECK(load_error(folder / "c.yaml") == (folder / "c.yaml").string() + ":1:10: extends: no such file: '" +
                                             (folder / "none.yaml").string() + "'");
  CHECK(load_error(folder / "d.yaml") ==
        (folder / "d.yaml").string() + ":1:10: extends: expects the path of a scene, got a list of 1");
}

TEST_CASE("a value that is set replaces the file's and may choose another alternative") {
  auto file = core::SceneFile::parse("section: {weak: {}, window: 1 ms, times: [1, 2]}", "scene.yaml");
  file.set("section.window", "50 us");
  file.set("section.times[1]", "7");
  file.set("section.strong.tolerance", "0.5");
  const auto coupling = read(file);
  CHECK(coupling.window == 50e-6);
  CHECK(coupling.times == std::vector<double>{1, 7});
  CHECK(std::get<Strong>(coupling.scheme).tolerance == 0.5);
  CHECK_THROWS_WITH(file.set("section.times[2]", "7"), "section.times[2]: there is no entry [2] here to set");
  CHECK_THROWS_WITH(file.set("section.window", "[1"), "section.window: cannot be set to '[1'");
  CHECK_THROWS_WITH(file.set("section.window.x", "1"), "section.window.x: 'x' stands in no map");
  file.set("section.window", "1 kg");
  CHECK(error(file) ==
        "setting of section.window:1:8: section.window: expects a time such as '50 us', got '1 kg'");
}

TEST_CASE("the hash tells contents apart but not layouts") {
  const auto hash = [](const std::string& text) { return core::SceneFile::parse(text, "a.yaml").hash(); };
  CHECK(hash("a: {b: 1, c: [2, 3]}") == hash("# note\na:\n  b: '1'\n  c:\n  - 2\n  - 3\n"));
  CHECK(hash("a: 1") != hash("a: 2"));
  CHECK(hash("a: [1, 2]") != hash("a: [12]"));
  CHECK(hash("a: x").size() == 16);
}

TEST_CASE("the effective scene as text reads back as the same scene") {
  Folder folder;
  folder.add("base.yaml", "section: {weak: {substeps: 3}, window: 1 ms}")
      .add("scene.yaml", "extends: base.yaml\nsection: {times: [4, \"5 \\\"x\\\"\"]}");
  const auto file = core::SceneFile::load(folder / "scene.yaml");
  CHECK(core::SceneFile::parse(file.text(), "copy.yaml").hash() == file.hash());
}

TEST_CASE("a solver named by a word is its section's program, to which later files and settings add") {
  Folder folder;
  folder.add("bases/base.yaml", "structure: {solver: mine.py}\nparticles: {solver: other}")
      .add("scene.yaml", "extends: bases/base.yaml\nstructure: {solver: {arguments: [-v]}}");
  auto file = core::SceneFile::load(folder / "scene.yaml");
  CHECK(file.path_at("structure.solver.program") == folder / "bases/mine.py");
  CHECK(file.text().find("-v") != std::string::npos);
  CHECK(file.path_at("particles.solver.program") == folder / "bases/other");
  file.set("structure.solver", "changed.py");
  CHECK(file.path_at("structure.solver.program").filename() == "changed.py");
}

}  // namespace talus
