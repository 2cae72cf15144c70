#include "coupler/launch/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "core/errors.hpp"

namespace talus::coupler::launch {
namespace {

constexpr int could_not_start = 127;  // as a shell says it

[[noreturn]] void become(char* const* arguments) {
  // A child stopped by SIGSTOP would outlive a killed coupler for good; continued, its participant notices
  // the death and ends it.
  prctl(PR_SET_PDEATHSIG, SIGCONT);
  signal(SIGINT, SIG_IGN);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  // Idle threads of GCC's OpenMP would spin for milliseconds after each loop, on cores that the other
  // processes of the run need next. A user's own choice stands.
  if (getenv("OMP_WAIT_POLICY") == nullptr) setenv("GOMP_SPINCOUNT", "1000", 0);
  execvp(arguments[0], arguments);
  _exit(could_not_start);
}

pid_t start(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) become(arguments.data());
  if (pid < 0) {
    throw core::TransportError({.peer = command.front(),
                                .waited_for = "the program to start",
                                .reason = fmt::format("could not be started ({})", strerror(errno))});
  }
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

Child::Child(const std::vector<std::string>& command) : handle_(transport::identify(start(command))) {}

Child::~Child() {
  if (pid() > 0 && !status()) kill();
}

std::optional<ExitStatus> Child::status() {
  int raw = 0;
  if (!status_ && pid() > 0 && waitpid(pid(), &raw, WNOHANG) == pid()) {
    status_ = WIFSIGNALED(raw) ? ExitStatus{.signal = WTERMSIG(raw)} : ExitStatus{.code = WEXITSTATUS(raw)};
  }
  return status_;
}

std::optional<ExitStatus> Child::wait_end(double seconds) {
  if (!status_) handle_.wait_end(static_cast<int>(std::ceil(seconds * 1000)));
  return status();
}

void Child::kill() {
  handle_.send_signal(SIGKILL);
  handle_.wait_end(-1);
  status();
}

}  // namespace talus::coupler::launch
