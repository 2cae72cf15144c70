#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "core/errors.hpp"
#include "coupler/participant.hpp"
#include "coupler/transport/layout.hpp"
#include "coupler/transport/process.hpp"
#include "coupler/transport/segment.hpp"

using namespace talus;
using namespace talus::coupler::transport;
using Catch::Matchers::Contains;

namespace {

/// A sound segment of this process that awaits a structure.
struct Sound {
  Sound() : control(initialise(segment->control(), true)) {
    control.header.coupler_start = this_process().start;
    control.header.coupler_pid = this_process().pid;
    control.channels[0].state = static_cast<std::uint32_t>(ChannelState::awaited);
  }
  std::unique_ptr<Segment> segment = create_shared_segment();
  Control& control;
  auto join() const {
    return coupler::Participant::join({.segment = segment->name(), .role = coupler::Role::structure});
  }
};

std::string refusal(const Sound& sound) {
  try {
    sound.join();
  } catch (const core::TransportError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a sound segment can be joined once, in the role it awaits") {
  const Sound sound;
  const auto participant = sound.join();
  CHECK_THAT(refusal(sound), Contains("awaits nobody in the role 'structure'"));
}

TEST_CASE("what a segment lies about is found before its content is used") {
  Sound sound;
  SECTION("magic number") {
    sound.control.header.magic = 7;
    CHECK_THAT(refusal(sound), Contains("is not a Talus coupling segment"));
  }
  SECTION("layout version") {
    sound.control.header.version = 99;
    CHECK_THAT(refusal(sound), Contains("has layout version 99, this program speaks version " +
                                        std::to_string(layout_version)));
  }
  SECTION("layout hash") {
    sound.control.header.layout_hash ^= 1;
    CHECK_THAT(refusal(sound), Contains("has layout hash"));
  }
  SECTION("size of the control data") {
    sound.control.header.control_bytes = 1 << 30;
    CHECK_THAT(refusal(sound), Contains("claims 1073741824 bytes of control data"));
  }
  SECTION("an object that is smaller than a control block") {
    const int file = shm_open(sound.segment->name().c_str(), O_RDWR, 0);
    REQUIRE(ftruncate(file, 100) == 0);
    close(file);
    CHECK_THAT(refusal(sound), Contains("holds 100 bytes"));
  }
  SECTION("no segment at all") {
    sound.segment->remove_name();
    CHECK_THAT(refusal(sound), Contains("cannot be opened"));
  }
}

TEST_CASE("a segment that claims more arrays than it holds is not mapped") {
  const Sound sound;
  const auto other = open_shared_segment(sound.segment->name());
  CHECK_THROWS_WITH(other->attach_data(1 << 20), Contains("claims 1048576 bytes of arrays"));
}

TEST_CASE("an array outside of the data block is refused, whatever its offset adds up to") {
  alignas(64) std::array<std::byte, 1024> data{};
  const auto refuses = [&](const ArraySlot& slot, std::uint64_t expected) {
    CHECK_THROWS_AS(checked_array(data, slot, expected), core::TransportError);
  };
  CHECK(checked_array(data, {.offset = 64, .count = 120}, 120).size() == 120);
  refuses({.offset = 64, .count = 121}, 121);
  refuses({.offset = 64, .count = 120}, 119);
  refuses({.offset = 65, .count = 1}, 1);
  refuses({.offset = 1088, .count = 1}, 1);
  refuses({.offset = ~std::uint64_t{63}, .count = 8}, 8);
  refuses({.offset = 64, .count = ~std::uint64_t{0}}, ~std::uint64_t{0});
}

TEST_CASE("a segment belongs to its user alone and its name cannot be guessed") {
  const auto first = create_shared_segment(), second = create_shared_segment();
  struct stat status {};
  REQUIRE(stat(("/dev/shm/" + first->name()).c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  CHECK(first->name().substr(first->name().rfind('-')).size() == 1 + 32);
  CHECK(first->name().substr(first->name().rfind('-')) != second->name().substr(second->name().rfind('-')));
}

TEST_CASE("segments of couplers that are gone are swept away, those of living ones are not") {
  const auto living = create_shared_segment();
  std::string name(256, '\0');
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto segment = create_shared_segment();
    const auto written = write(ends[1], segment->name().data(), segment->name().size());
    (void)written;
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  name.resize(static_cast<std::size_t>(read(ends[0], name.data(), name.size())));
  close(ends[0]);
  close(ends[1]);
  REQUIRE(std::filesystem::exists("/dev/shm/" + name));
  CHECK(remove_stale_segments() >= 1);
  CHECK_FALSE(std::filesystem::exists("/dev/shm/" + name));
  CHECK(std::filesystem::exists("/dev/shm/" + living->name()));
}

TEST_CASE("a process is told apart from a later one with the same id") {
  const ProcessIdentity self = this_process();
  CHECK(ProcessHandle(self).alive());
  CHECK_FALSE(ProcessHandle({.pid = self.pid, .start = self.start + 1}).alive());
  CHECK(activity_of(self.pid)->state == ProcessActivity::State::runs);
}

TEST_CASE("a process is not taken for dead because no descriptor is left to watch it") {
  const pid_t child = fork();
  if (child == 0) {
    pause();
    _exit(0);
  }
  const ProcessIdentity identity = identify(child);
  rlimit usual{};
  getrlimit(RLIMIT_NOFILE, &usual);
  const int next = dup(STDIN_FILENO);
  close(next);
  rlimit none_left = usual;
  none_left.rlim_cur = static_cast<rlim_t>(next);
  setrlimit(RLIMIT_NOFILE, &none_left);
  const ProcessHandle handle(identity);
  const bool alive = handle.alive();
  setrlimit(RLIMIT_NOFILE, &usual);
  CHECK(alive);
  CHECK_FALSE(handle.wait_end(30));
  handle.send_signal(SIGKILL);
  CHECK(handle.wait_end(5000));
  CHECK(waitpid(child, nullptr, 0) == child);
}

TEST_CASE("shared memory that does not suffice is an error that says how much and how to enlarge it") {
  struct statvfs room {};
  REQUIRE(statvfs("/dev/shm", &room) == 0);
  if (room.f_blocks == 0) return;  // this machine sets no limit
  const auto segment = create_shared_segment();
  const std::size_t size = room.f_blocks * room.f_frsize;
  try {
    segment->create_data(size);
    FAIL("not refused");
  } catch (const core::MachineError& error) {
    CHECK_THAT(error.what(), Contains("of shared memory, but /dev/shm has ") &&
                                 Contains("docker run --shm-size=") && Contains("mount -o remount,size="));
  }
  CHECK(segment->real_bytes() < size);  // nothing was taken
}
