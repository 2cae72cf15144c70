#include "coupler/launch/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/errors.hpp"

namespace talus::coupler::launch {
namespace {

constexpr int could_not_start = 127;  // as a shell says it

/// Signals that the coupler handles or ignores and whose default a program may expect.
constexpr std::array own_signals{SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGPIPE, SIGXFSZ};

/// What the new process is to become, made before it is split off: afterwards nothing may allocate.
struct Becoming {
  const std::vector<char*>& arguments;
  const std::vector<char*>& environment;
  const char* folder = nullptr;  ///< null: ours
  int log = -1;                  ///< a file for all output; negative: none
};

std::string_view name_in(std::string_view assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// Our variables, with those of `more` in their places.
std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = more;
  const auto is_set = [&all](std::string_view name) {
    return std::ranges::any_of(all, [name](const std::string& one) { return name_in(one) == name; });
  };
  for (char** ours = environ; *ours != nullptr; ++ours)
    if (!is_set(name_in(*ours))) all.emplace_back(*ours);
  // Idle threads of GCC's OpenMP would spin for milliseconds after each loop, on cores that the other
  // processes of the run need next. A user's own choice stands.
  if (!is_set("OMP_WAIT_POLICY") && !is_set("GOMP_SPINCOUNT")) all.emplace_back("GOMP_SPINCOUNT=1000");
  return all;
}

std::vector<char*> pointers_to(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const auto& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

[[noreturn]] void become(const Becoming& program) {
  setpgid(0, 0);
  // A child stopped by SIGSTOP would outlive a killed coupler for good; continued, its participant notices
  // the death and ends it.
  prctl(PR_SET_PDEATHSIG, SIGCONT);
  for (const int number : own_signals) signal(number, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  if (nothing > STDIN_FILENO) close(nothing);
  if (program.log >= 0) dup2(program.log, STDERR_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  if (program.folder == nullptr || chdir(program.folder) == 0)
    execvpe(program.arguments[0], program.arguments.data(), program.environment.data());
  _exit(could_not_start);
}

/// -1 without a path. The file is closed in what the child becomes.
int open_log(const std::filesystem::path& path) {
  if (path.empty()) return -1;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw core::FileError(path, "written", errno);
  return file;
}

pid_t start(const Program& program, const std::filesystem::path& log) {
  const int file = open_log(log);
  const auto environment = environment_with(program.environment);
  const std::vector<char*> arguments = pointers_to(program.command), variables = pointers_to(environment);
  const Becoming becoming{.arguments = arguments,
                          .environment = variables,
                          .folder = program.folder.empty() ? nullptr : program.folder.c_str(),
                          .log = file};
  const pid_t pid = fork();
  if (pid == 0) become(becoming);
  if (file >= 0) close(file);
  if (pid < 0) {
    throw core::TransportError({.peer = program.command.front(),
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

Child::Child(const Program& program, const std::filesystem::path& log)
    : pid_(start(program, log)), handle_(transport::identify(pid_)) {}

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
