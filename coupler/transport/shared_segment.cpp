#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/errors.hpp"
#include "coupler/transport/layout.hpp"
#include "coupler/transport/process.hpp"
#include "coupler/transport/segment.hpp"

namespace talus::coupler::transport {
namespace {

namespace ipc = boost::interprocess;

constexpr const char* prefix = "talus-";

[[noreturn]] void refuse(const std::string& name, std::string reason) {
  throw core::TransportError({.peer = "segment " + name,
                              .waited_for = "shared memory",
                              .reason = std::move(reason),
                              .waiter = "this program"});
}

/// "talus-<pid>-<start time>-<128 random bits>": the owner is in the name for remove_stale_segments(), the
/// random part keeps others from guessing or occupying it.
std::string fresh_name() {
  const ProcessIdentity owner = this_process();
  std::random_device random;  // reads the kernel's generator
  std::string name = fmt::format("{}{}-{}-", prefix, owner.pid, owner.start);
  for (int word = 0; word < 4; ++word) name += fmt::format("{:08x}", random());
  return name;
}

std::size_t size_of(const ipc::shared_memory_object& object) {
  struct stat status {};
  return fstat(object.get_mapping_handle().handle, &status) == 0 ? static_cast<std::size_t>(status.st_size)
                                                                 : 0;
}

/// "81.2 MB"
std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

/// A container gets 64 MB of shared memory unless it is asked for more; a machine gives half of its memory.
[[noreturn]] void say_too_small(std::uint64_t wanted, const struct statvfs& room) {
  constexpr std::uint64_t megabyte = 1'000'000;
  const std::uint64_t size = room.f_blocks * room.f_frsize, free = room.f_bavail * room.f_frsize;
  const std::uint64_t enough = (size + wanted) / megabyte + 1;
  throw core::MachineError(fmt::format(
      "the run needs {} of shared memory, but /dev/shm has {} of which {} are free; enlarge it by "
      "`docker run --shm-size={}m ...` in a container, else by `mount -o remount,size={}m /dev/shm`",
      megabytes(wanted), megabytes(size), megabytes(free), enough, enough));
}

/// Asked for before memory is taken, so that a run that does not fit does not drive others out.
void refuse_without_room(int descriptor, std::uint64_t more) {
  struct statvfs room {};
  if (fstatvfs(descriptor, &room) != 0 || room.f_blocks == 0) return;  // no limit
  if (room.f_bavail * room.f_frsize < more) say_too_small(more, room);
}

/// Sets the size and reserves the memory behind it, so that a full /dev/shm is an error here and not a SIGBUS
/// at the first write.
void reserve(ipc::shared_memory_object& object, std::size_t bytes) {
  const int descriptor = object.get_mapping_handle().handle;
  const std::size_t present = size_of(object);
  refuse_without_room(descriptor, bytes > present ? bytes - present : 0);
  int error = ftruncate(descriptor, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
  if (error == 0) error = posix_fallocate(descriptor, 0, static_cast<off_t>(bytes));
  if (error != 0)
    throw core::MachineError(fmt::format("no room for {} of shared memory in /dev/shm: {}", megabytes(bytes),
                                         std::strerror(error)));
}

class SharedSegment final : public Segment {
 public:
  SharedSegment(ipc::shared_memory_object object, bool owner) : object_(std::move(object)), owner_(owner) {}
  ~SharedSegment() override {
    if (owner_) remove_name();
  }

  void create_control() {
    reserve(object_, sizeof(Control));
    map_control();
  }
  void map_control() { control_ = ipc::mapped_region(object_, ipc::read_write, 0, sizeof(Control)); }

  std::span<std::byte> control() override { return bytes_of(control_); }
  std::span<std::byte> data() override { return bytes_of(data_); }
  std::size_t real_bytes() const override { return size_of(object_); }
  std::string name() const override { return object_.get_name(); }

  void create_data(std::size_t bytes) override {
    reserve(object_, sizeof(Control) + bytes);
    map_data(bytes);
  }
  void attach_data(std::size_t bytes) override {
    const std::size_t real = size_of(object_);
    if (real < sizeof(Control) || real - sizeof(Control) < bytes) {
      refuse(name(), fmt::format("claims {} bytes of arrays, but holds {} bytes in all", bytes, real));
    }
    map_data(bytes);
  }
  void remove_name() noexcept override {
    if (!removed_) ipc::shared_memory_object::remove(object_.get_name());
    removed_ = true;
  }

 private:
  static std::span<std::byte> bytes_of(const ipc::mapped_region& region) {
    return {static_cast<std::byte*>(region.get_address()), region.get_size()};
  }
  void map_data(std::size_t bytes) {
    if (bytes > 0) data_ = ipc::mapped_region(object_, ipc::read_write, sizeof(Control), bytes);
  }

  ipc::shared_memory_object object_;
  ipc::mapped_region control_, data_;
  bool owner_;
  bool removed_ = false;
};

/// The owner written into a segment's name, or pid 0 where the name is not one of ours.
ProcessIdentity owner_in(const std::string& name) {
  ProcessIdentity owner;
  if (!name.starts_with(prefix)) return owner;
  const char* const end = name.data() + name.size();
  const auto pid = std::from_chars(name.data() + std::strlen(prefix), end, owner.pid);
  if (pid.ec != std::errc{} || pid.ptr == end || *pid.ptr != '-') return {};
  const auto start = std::from_chars(pid.ptr + 1, end, owner.start);
  return start.ec == std::errc{} && start.ptr != end && *start.ptr == '-' ? owner : ProcessIdentity{};
}

}  // namespace

std::unique_ptr<Segment> create_shared_segment() {
  const std::string name = fresh_name();
  try {
    ipc::shared_memory_object object(ipc::create_only, name.c_str(), ipc::read_write, ipc::permissions(0600));
    auto segment = std::make_unique<SharedSegment>(std::move(object),
                                                   true);  // from here on the name is removed on any error
    segment->create_control();
    return segment;
  } catch (const ipc::interprocess_exception& error) {
    throw core::MachineError(
        fmt::format("shared memory cannot be had: '/dev/shm/{}' cannot be created ({})", name, error.what()));
  }
}

std::unique_ptr<Segment> open_shared_segment(const std::string& name) {
  try {
    ipc::shared_memory_object object(ipc::open_only, name.c_str(), ipc::read_write);
    if (const std::size_t real = size_of(object); real < sizeof(Control)) {
      refuse(name, fmt::format("holds {} bytes, a coupling segment has at least {}", real, sizeof(Control)));
    }
    auto segment = std::make_unique<SharedSegment>(std::move(object), false);
    segment->map_control();
    return segment;
  } catch (const ipc::interprocess_exception& error) {
    refuse(name, fmt::format("cannot be opened ({})", error.what()));
  }
}

int remove_stale_segments() {
  int removed = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm", error)) {
    const std::string name = entry.path().filename();
    const ProcessIdentity owner = owner_in(name);
    if (owner.pid > 0 && !ProcessHandle(owner).alive() && ipc::shared_memory_object::remove(name.c_str()))
      ++removed;
  }
  return removed;
}

}  // namespace talus::coupler::transport
