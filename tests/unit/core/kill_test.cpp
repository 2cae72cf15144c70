#include <hdf5.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "core/output/field_store.hpp"
#include "core/output/result_writer.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/moving_net.hpp"

namespace talus {
namespace {

using test::Folder;
using test::MovingNet;
using test::text_of;

constexpr std::int64_t nodes = 3000;  // frames of some hundred kilobytes, so that kills fall inside of them
constexpr std::int64_t frames = 500;
constexpr int kills = 50;

/// Writes rows and frames as fast as it can, until it is killed.
[[noreturn]] void write_for_ever(const std::filesystem::path& folder) {
  MovingNet net(nodes);
  core::ResultWriter writer({.folder = folder,
                             .title = "t",
                             .program = "p",
                             .scene = "s",
                             .scene_hash = "h",
                             .frame_capacity = frames},
                            {&net});
  for (std::int64_t i = 0; i < frames; ++i) {
    net.frame = static_cast<double>(i);
    writer.write_row(net.frame);
    writer.write_fields(net.frame);
  }
  for (;;) ::pause();
}

/// Whole rows of a table of numbers: the columns of each must be as many as the header's.
std::size_t check_table(const std::filesystem::path& path) {
  std::istringstream lines(text_of(path));
  std::string line;
  std::getline(lines, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  std::size_t rows = 0;
  while (std::getline(lines, line) && !lines.eof()) {
    if (std::count(line.begin(), line.end(), ',') != columns) FAIL(path << " has the torn row " << line);
    ++rows;
  }
  return rows;
}

struct H5Reader {
  explicit H5Reader(const std::filesystem::path& path)
      : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    REQUIRE(file >= 0);
  }
  ~H5Reader() { H5Fclose(file); }
  hid_t file;

  /// Some numbers of a dataset, from a place on.
  std::vector<double> read(const char* dataset, const std::vector<hsize_t>& start,
                           const std::vector<hsize_t>& count) const {
    const hid_t data = H5Dopen2(file, dataset, H5P_DEFAULT), space = H5Dget_space(data);
    hsize_t total = 1;
    for (const auto c : count) total *= c;
    const hid_t memory = H5Screate_simple(1, &total, nullptr);
    std::vector<double> values(total);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    REQUIRE(H5Dread(data, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) >= 0);
    H5Sclose(memory), H5Sclose(space), H5Dclose(data);
    return values;
  }
};

/// The last complete frame must be whole: every value follows from the frame's number. Returns the number of
/// frames.
std::size_t check_frames(const std::filesystem::path& path) {
  const H5Reader reader(path);
  const double written = reader.read("frames_written", {0}, {1}).front();
  if (written == 0) return 0;
  const auto last = static_cast<std::int64_t>(written) - 1;
  const double frame = static_cast<double>(last);
  REQUIRE(reader.read("time", {static_cast<hsize_t>(last)}, {1}).front() == frame);
  const auto positions = reader.read(("net/position/" + core::frame_name(last)).c_str(), {0, 0}, {nodes, 3});
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i] != frame + static_cast<double>(i))
      FAIL("frame " << last << " is torn at position " << i);
  for (const double force :
       reader.read(("net/axial_force/" + core::frame_name(last)).c_str(), {0, 0}, {nodes - 1, 1}))
    if (force != 2000 + frame) FAIL("frame " << last << " is torn in its forces");
  return static_cast<std::size_t>(written);
}

/// Kills a writer some time after its first row.
void kill_a_writer(const std::filesystem::path& folder, std::chrono::microseconds after) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) write_for_ever(folder);
  while (!std::filesystem::exists(folder / "summary.json"))
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  std::this_thread::sleep_for(after);
  ::kill(child, SIGKILL);
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

}  // namespace

TEST_CASE("whatever was written stays readable when the writer is killed at any moment") {
  std::mt19937 random(20240607);
  std::uniform_int_distribution<int> pause(0, 30000);
  std::size_t most_frames = 0;
  for (int i = 0; i < kills; ++i) {
    Folder folder("kill");
    const auto result = folder / "result";
    kill_a_writer(result, std::chrono::microseconds(pause(random)));
    CHECK(nlohmann::json::parse(text_of(result / "summary.json"))["status"] == "running");
    const std::size_t probe_rows = check_table(result / "probes.csv"),
                      energy_rows = check_table(result / "energy.csv");
    CHECK(probe_rows - energy_rows <= 1);  // the kill may fall between the two
    const std::size_t written = check_frames(result / "fields.h5");
    CHECK(probe_rows >= written);
    most_frames = std::max(most_frames, written);
    if (written == 0) continue;
    pugi::xml_document xdmf;
    REQUIRE(xdmf.load_file((result / "fields.xdmf").c_str()));
    CHECK(xdmf.select_nodes("//Time").size() <= written);
  }
  CHECK(most_frames > 10);
}

}  // namespace talus
