#include "coupler/launch/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/errors.hpp"

namespace talus::coupler::launch {
namespace {

constexpr int could_not_start = 127;  // as a shell says it

/// Signals that the coupler handles or ignores and whose default a program may expect.
constexpr std::array own_signals{SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGPIPE, SIGXFSZ};

/// @param log a file for all output; negative: none
[[noreturn]] void become(char* const* arguments, int log) {
  setpgid(0, 0);
  // A child stopped by SIGSTOP would outlive a killed coupler for good; continued, its participant notices
  // the death and ends it.
  prctl(PR_SET_PDEATHSIG, SIGCONT);
  for (const int number : own_signals) signal(number, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  if (nothing > STDIN_FILENO) close(nothing);
  if (log >= 0) dup2(log, STDERR_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  // Idle threads of GCC's OpenMP would spin for milliseconds after each loop, on cores that the other
  // processes of the run need next. A user's own choice stands.
  if (getenv("OMP_WAIT_POLICY") == nullptr) setenv("GOMP_SPINCOUNT", "1000", 0);
  execvp(arguments[0], arguments);
  _exit(could_not_start);
}

/// -1 without a path. The file is closed in what the child becomes.
int open_log(const std::filesystem::path& path) {
  if (path.empty()) return -1;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw core::FileError(path, "written", errno);
  return file;
}

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int file = open_log(log);
  const pid_t pid = fork();
  if (pid == 0) become(arguments.data(), file);
  if (file >= 0) close(file);
  if (pid < 0) {
    throw core::TransportError({.peer = command.front(),
                                .waited_for = "the program to start",
                                .reason = fmt::format("could not be started ({})", strerror(errno))});
  }
  setpgid(pid, pid);  // both do: whichever comes first
  return pid;
}

}  // namespace

std::string ExitStatus::text() const {
  if (signal != 0) {
    const char* name = sigabbrev_np(signal);
    return fmt::format("was killed by signal {} (SIG{})", signal, name != nullptr ? name : "?");
  }
  if (code == could_not_start) return "could not be started";
  return fmt::format("ended with exit code {}", code);
}

Child::Child(const std::vector<std::string>& command, const std::filesystem::path& log)
    : pid_(start(command, log)), handle_(transport::identify(pid_)) {}

Child::Child(Child&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)), handle_(std::move(other.handle_)), status_(other.status_) {}

Child::~Child() {
  end();
}

std::optional<ExitStatus> Child::status() {
  siginfo_t info{};
  if (status_ || pid_ <= 0) return status_;
  if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != pid_)
    return std::nullopt;
  status_ =
      info.si_code == CLD_EXITED ? ExitStatus{.code = info.si_status} : ExitStatus{.signal = info.si_status};
  return status_;
}

std::optional<ExitStatus> Child::wait_end(double seconds) {
  if (!status_) handle_.wait_end(static_cast<int>(std::ceil(seconds * 1000)));
  return status();
}

void Child::signal_group(int signal) const noexcept {
  if (pid_ > 0) ::kill(-pid_, signal);
}

void Child::ask_to_end() noexcept {
  signal_group(SIGTERM);
  signal_group(SIGCONT);
}

void Child::kill() noexcept {
  signal_group(SIGKILL);
}

void Child::end() noexcept {
  if (pid_ <= 0) return;
  if (!status()) {
    ask_to_end();
    wait_end(patience);
  }
  kill();  // also what a child that has ended left behind
  wait_end(patience);
  waitpid(pid_, nullptr, WNOHANG);
  pid_ = 0;
}

}  // namespace talus::coupler::launch
