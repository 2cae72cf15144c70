#include "coupler/coupler_watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "core/errors.hpp"
#include "core/program/log.hpp"

namespace talus::coupler {
namespace {

constexpr int grace_milliseconds = 500;

/// Sleeps until one of the descriptors is readable; true if `stop` is, false after the time or where only the
/// other is.
bool stopped(int stop, int other, int milliseconds) {
  std::array<pollfd, 2> entries{pollfd{.fd = stop, .events = POLLIN, .revents = 0},
                                pollfd{.fd = other, .events = POLLIN, .revents = 0}};
  int ready = 0;
  do {
    ready = poll(entries.data(), entries.size(), milliseconds);
  } while (ready < 0 && errno == EINTR);
  return (entries[0].revents & POLLIN) != 0;
}

}  // namespace

CouplerWatch::CouplerWatch(const transport::ProcessIdentity& coupler, const char* role)
    : stop_(eventfd(0, EFD_CLOEXEC)) {
  thread_ = std::thread([stop = stop_, handle = transport::ProcessHandle(coupler), role] {
    if (stopped(stop, handle.descriptor(), -1)) return;
    constexpr int nothing = -1;  // poll() skips it
    if (stopped(stop, nothing, grace_milliseconds)) return;
    core::log_error(fmt::format("the coupler (pid {}) died while {} was computing", handle.pid(), role));
    _exit(static_cast<int>(core::ExitCode::transport));
  });
}

CouplerWatch::~CouplerWatch() {
  eventfd_write(stop_, 1);
  thread_.join();
  close(stop_);
}

}  // namespace talus::coupler
