#include "core/output/file.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/checkpoint.hpp"
#include "core/output/field_store.hpp"
#include "core/output/result_writer.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/moving_net.hpp"

namespace talus {
namespace {

using core::Durability;
using core::FileError;
using core::OutputFile;
using test::Folder;
using test::text_of;

/// As long as this lives no file may grow beyond so many bytes: writes then fail as on a full disk, with
/// "File too large" for a reason, and anybody may ask for it.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit small{bytes, usual_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    ::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &usual_);
    ::signal(SIGXFSZ, SIG_DFL);
  }
  SmallFiles(const SmallFiles&) = delete;

 private:
  rlimit usual_{};
};

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

void write_state(const std::filesystem::path& path, double number,
                 const core::CheckpointWriter::Place& place) {
  core::CheckpointWriter writer(path, "test");
  std::vector<double> values{number};
  writer.values("state", values);
  writer.text("said", "words");
  writer.commit(place);
}

double state_of(const std::filesystem::path& path) {
  std::vector<double> values(1);
  core::CheckpointReader(path, "test").values("state", values);
  return values.front();
}

}  // namespace

TEST_CASE("a write that the system refuses is an error that names the file and the cause") {
  OutputFile full("/dev/full", OutputFile::Mode::append);
  CHECK_THROWS_WITH(full.append("a"), "'/dev/full' cannot be written: No space left on device");
  CHECK_THROWS_WITH(OutputFile("/proc/none/a", OutputFile::Mode::create),
                    "'/proc/none/a' cannot be opened for writing: No such file or directory");
  CHECK_THROWS_AS(core::replace_file("/proc/none/a", "text"), FileError);
}

TEST_CASE("a file that cannot be replaced keeps its content, and nothing is left beside it") {
  Folder folder("replace");
  core::replace_file(folder / "a.txt", "old", Durability::power_loss);
  {
    const SmallFiles limit(10);
    CHECK_THROWS_AS(core::replace_file(folder / "a.txt", std::string(100, 'x')), FileError);
  }
  CHECK(text_of(folder / "a.txt") == "old");
  CHECK(names_in(folder.path()) == std::vector<std::string>{"a.txt"});
}

TEST_CASE("whatever a killed run left under a temporary name is written over, not followed") {
  Folder folder("left_over");
  folder.add("target", "mine").add("b.txt.part", "half");
  std::filesystem::create_symlink(folder / "target", folder / "a.txt.part");
  std::filesystem::permissions(folder / "b.txt.part", std::filesystem::perms::none);
  core::replace_file(folder / "a.txt", "new");
  core::replace_file(folder / "b.txt", "new");
  CHECK(text_of(folder / "a.txt") == "new");
  CHECK(text_of(folder / "b.txt") == "new");
  CHECK(text_of(folder / "target") == "mine");
  CHECK(names_in(folder.path()) == std::vector<std::string>{"a.txt", "b.txt", "target"});
}

TEST_CASE("a folder with nothing but left-over temporary files counts as empty") {
  Folder folder("left_over");
  folder.add("result/summary.json.part", "{")
      .add("result/checkpoint_of_structure.part", "")
      .add("result/reserve.part", "");
  { core::ResultFolder result(folder / "result", core::ResultFolder::Existing::refuse); }
  CHECK(names_in(folder / "result").empty());
  folder.add("result/notes.part", "mine");
  CHECK_THROWS_AS(core::ResultFolder(folder / "result", core::ResultFolder::Existing::refuse),
                  core::ConfigError);
  CHECK(text_of(folder / "result/notes.part") == "mine");
}

TEST_CASE("a checkpoint keeps the one before it, and one that cannot be written leaves both") {
  Folder folder("checkpoint");
  const core::CheckpointWriter::Place place{Durability::power_loss, folder / "before.h5"};
  write_state(folder / "last.h5", 1, place);
  CHECK_FALSE(std::filesystem::exists(folder / "before.h5"));
  write_state(folder / "last.h5", 2, place);
  write_state(folder / "last.h5", 3, place);
  {
    const SmallFiles limit(1000);
    CHECK_THROWS_AS(write_state(folder / "last.h5", 4, place), core::MachineError);
  }
  CHECK(state_of(folder / "last.h5") == 3);
  CHECK(state_of(folder / "before.h5") == 2);
  write_state(folder / "last.h5", 5, place);
  CHECK(state_of(folder / "before.h5") == 3);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"before.h5", "last.h5"});
  core::CheckpointReader reader(folder / "last.h5", "test");
  CHECK(reader.text("said") == "words");
  CHECK_FALSE(reader.text("unsaid").has_value());
}

TEST_CASE("a field file that does not fit is an error, whatever its size, and never a crash of the library") {
  Folder folder("fields");
  const test::MovingNet net(30);
  const auto& groups = net.description().groups;
  const rlim_t limit = GENERATE(0, 500, 2000, 5000, 20000);
  const SmallFiles small(limit);
  CHECK_THROWS_AS(core::FieldStore(folder / "fields.h5", groups, 1000), core::MachineError);
}

TEST_CASE("a run whose disk is full has a summary that says so and why") {
  Folder folder("full");
  test::MovingNet net;
  core::ResultWriter writer({.folder = folder / "result", .title = "t", .program = "p", .scene = "s"},
                            {&net});
  CHECK(std::filesystem::file_size(folder / "result/reserve.part") > 10000);
  const SmallFiles limit(4096);  // a summary fits
  const auto write_on = [&] {
    for (net.frame = 0; net.frame < 10000; ++net.frame) writer.write_row(net.frame);
  };
  CHECK_THROWS_WITH(write_on(), Catch::Contains("cannot be written: File too large"));
  writer.give_up("the first cause");
  const auto summary = nlohmann::json::parse(text_of(folder / "result/summary.json"));
  CHECK(summary["status"] == "failed");
  CHECK(summary["message"] == "the first cause");
  CHECK_FALSE(std::filesystem::exists(folder / "result/reserve.part"));
}

TEST_CASE("a run whose files cannot even be made has a summary that says so") {
  Folder folder("full");
  const test::MovingNet net(30);
  const SmallFiles limit(4096);
  const core::ResultWriter::Options options{.folder = folder / "result",
                                            .title = "t",
                                            .program = "p",
                                            .scene = "s",
                                            .scene_hash = "h",
                                            .frame_capacity = 1000};
  CHECK_THROWS_AS(core::ResultWriter(options, {&net}), core::MachineError);
  const auto summary = nlohmann::json::parse(text_of(folder / "result/summary.json"));
  CHECK(summary["status"] == "failed");
  CHECK(summary["scene_hash"] == "h");
}

}  // namespace talus
