#include "coupler/transport/process.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <utility>

namespace talus::coupler::transport {
namespace {

struct Status {
  char state = 'X';
  std::uint64_t start = 0;
};

/// Fields 3 (state) and 22 (start time) of /proc/PID/stat, proc(5). The program's name in field 2 may hold
/// spaces and brackets, so reading starts behind its last bracket.
Status status_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text);
  const auto bracket = text.rfind(')');
  if (bracket == std::string::npos) return {};
  std::istringstream fields(text.substr(bracket + 1));
  Status status;
  fields >> status.state;
  std::string skipped;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  fields >> status.start;
  return status;
}

int open_process(pid_t pid) {
  return static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
}

}  // namespace

ProcessIdentity this_process() {
  return identify(getpid());
}

ProcessIdentity identify(pid_t pid) {
  return {.pid = pid, .start = status_of(pid).start};
}

ProcessHandle::ProcessHandle(const ProcessIdentity& identity)
    : identity_(identity), descriptor_(open_process(identity.pid)) {
  // The start time is compared after the handle is open: from here on the handle cannot change its meaning.
  gone_ = descriptor_ < 0 || identify(identity.pid) != identity;
}

ProcessHandle::~ProcessHandle() {
  if (descriptor_ >= 0) close(descriptor_);
}

ProcessHandle::ProcessHandle(ProcessHandle&& other) noexcept
    : identity_(other.identity_), descriptor_(std::exchange(other.descriptor_, -1)), gone_(other.gone_) {}

ProcessHandle& ProcessHandle::operator=(ProcessHandle&& other) noexcept {
  std::swap(identity_, other.identity_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(gone_, other.gone_);
  return *this;
}

bool ProcessHandle::alive() const noexcept {
  return !wait_end(0);
}

bool ProcessHandle::wait_end(int milliseconds) const noexcept {
  if (gone_) return true;
  if (descriptor_ < 0) return false;
  pollfd entry{.fd = descriptor_, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = poll(&entry, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

void ProcessHandle::send_signal(int signal) const noexcept {
  if (!gone_ && descriptor_ >= 0) syscall(SYS_pidfd_send_signal, descriptor_, signal, nullptr, 0);
}

std::string process_condition(pid_t pid) {
  switch (status_of(pid).state) {
    case 'R':
      return "runs";
    case 'T':
    case 't':
      return "is stopped";
    case 'S':
    case 'D':
      return "sleeps";
    default:
      return "is gone";
  }
}

}  // namespace talus::coupler::transport
