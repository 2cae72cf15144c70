#include "coupler/study/child_run.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <system_error>
#include <thread>

#include "core/program/stop.hpp"

namespace talus::study {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll_interval{5};
constexpr std::chrono::seconds patience{5};  // between asking a run to end and killing it

/// In the child, after fork: nothing here may allocate.
[[noreturn]] void become(char* const* arguments, int log) {
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  setpgid(0, 0);  // Ctrl-C in a terminal is for the study, which then asks the run to end
  execv(arguments[0], arguments);
  _exit(127);
}

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw std::system_error(errno, std::generic_category(), log.string());
  const pid_t pid = ::fork();
  if (pid == 0) become(arguments.data(), file);
  ::close(file);
  if (pid < 0) throw std::system_error(errno, std::generic_category(), command.front());
  return pid;
}

/// The status of `pid` once it has ended, waiting until `deadline`.
bool wait_until(pid_t pid, Clock::time_point deadline, int& status, bool heed_stop) {
  while (::waitpid(pid, &status, WNOHANG) == 0) {
    if (Clock::now() >= deadline || (heed_stop && core::stop_requested())) return false;
    std::this_thread::sleep_for(poll_interval);
  }
  return true;
}

void end(pid_t pid) {
  int status = 0;
  ::kill(pid, SIGTERM);
  if (wait_until(pid, Clock::now() + patience, status, false)) return;
  ::kill(pid, SIGKILL);
  ::waitpid(pid, &status, 0);
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log,
                   double time_limit) {
  const auto started = Clock::now();
  const auto deadline =
      started + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_limit));
  const pid_t pid = start(command, log);
  int status = 0;
  const bool ended = wait_until(pid, deadline, status, true);
  const double seconds = std::chrono::duration<double>(Clock::now() - started).count();
  if (!ended) {
    end(pid);
    return {core::stop_requested() ? ChildEnd::Reason::stop_requested : ChildEnd::Reason::time_limit, 0,
            seconds};
  }
  if (WIFSIGNALED(status)) return {ChildEnd::Reason::killed, WTERMSIG(status), seconds};
  return {ChildEnd::Reason::exited, WEXITSTATUS(status), seconds};
}

}  // namespace talus::study
