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
  double cpu_time = 0;  ///< s
};

/// Fields 3 (state), 14 and 15 (time in user and kernel mode) and 22 (start time) of /proc/PID/stat, proc(5).
/// The program's name in field 2 may hold spaces and brackets, so reading starts behind its last bracket.
/// Nothing where there is no such file, or no descriptor left to read it.
std::optional<Status> status_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text);
  const auto bracket = text.rfind(')');
  if (bracket == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(bracket + 1));
  Status status;
  fields >> status.state;
  std::string skipped;
  for (int field = 4; field < 14; ++field) fields >> skipped;
  std::uint64_t user = 0, kernel = 0;
  fields >> user >> kernel;
  status.cpu_time = static_cast<double>(user + kernel) / static_cast<double>(sysconf(_SC_CLK_TCK));
  for (int field = 16; field < 22; ++field) fields >> skipped;
  fields >> status.start;
  return status;
}

bool has_ended(const Status& status) {
  return status.state == 'Z' || status.state == 'X';
}

int open_process(pid_t pid) {
  return static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
}

}  // namespace

ProcessIdentity this_process() {
  return identify(getpid());
}

ProcessIdentity identify(pid_t pid) {
  const auto status = status_of(pid);
  return {.pid = pid, .start = status ? status->start : 0};
}

ProcessHandle::ProcessHandle(const ProcessIdentity& identity)
    : identity_(identity), descriptor_(open_process(identity.pid)) {
  gone_ = descriptor_ < 0 && errno == ESRCH;
  // The start time is compared after the handle is open: from here on the handle cannot change its meaning.
  gone_ = gone_ || !there_by_id();
}

bool ProcessHandle::there_by_id() const noexcept {
  if (kill(identity_.pid, 0) != 0 && errno == ESRCH) return false;
  const auto status = status_of(identity_.pid);
  if (!status) return true;  // the kernel knows the id, and nothing more can be told
  return !has_ended(*status) && (identity_.start == 0 || status->start == identity_.start);
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
  if (identity_.pid == 0) return false;
  if (descriptor_ < 0) return wait_end_by_id(milliseconds);
  pollfd entry{.fd = descriptor_, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = poll(&entry, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

bool ProcessHandle::wait_end_by_id(int milliseconds) const noexcept {
  constexpr int pause = 10;  // ms
  for (int waited = 0; there_by_id(); waited += pause) {
    if (milliseconds >= 0 && waited >= milliseconds) return false;
    poll(nullptr, 0, pause);
  }
  return true;
}

void ProcessHandle::send_signal(int signal) const noexcept {
  if (gone_ || identity_.pid <= 0) return;
  if (descriptor_ >= 0) {
    syscall(SYS_pidfd_send_signal, descriptor_, signal, nullptr, 0);
  } else if (there_by_id()) {
    kill(identity_.pid, signal);
  }
}

std::optional<ProcessActivity> activity_of(pid_t pid) {
  using State = ProcessActivity::State;
  const auto status = status_of(pid);
  if (!status) return std::nullopt;
  const auto state = [&] {
    switch (status->state) {
      case 'R':
        return State::runs;
      case 'T':
      case 't':
        return State::stopped;
      case 'D':
        return State::waits_for_disk;
      case 'Z':
      case 'X':
        return State::gone;
      default:
        return State::sleeps;
    }
  };
  return ProcessActivity{state(), status->cpu_time};
}

}  // namespace talus::coupler::transport
