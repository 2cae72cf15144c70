#include "tests/support/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <thread>

namespace talus::test {

Program::Program(const std::vector<std::string>& command, const std::filesystem::path& output)
    : output_(output) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  setpgid(0, 0);
  ::signal(SIGHUP, SIG_DFL);  // the tests may run under nohup
  const int file = open(output.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execv(arguments[0], arguments.data());
  _exit(127);
}

Program::~Program() {
  kill(-pid_, SIGKILL);
  waitpid(pid_, nullptr, WNOHANG);
}

Ended Program::wait(std::chrono::seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline)
      throw std::runtime_error("the program did not end: " + text_of(output_));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .output = text_of(output_)};
}

void Program::signal(int number) const {
  kill(pid_, number);
}

void Program::signal_group(int number) const {
  kill(-pid_, number);
}

std::vector<ChildProcess> children_of(int pid) {
  const std::string self = std::to_string(pid);
  std::ifstream list("/proc/" + self + "/task/" + self + "/children");
  std::vector<ChildProcess> children;
  for (int child = 0; list >> child;) {
    std::string name;
    std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
    children.push_back({.pid = child, .name = name});
  }
  return children;
}

bool exists(int pid) {
  // A zombie is gone for this purpose only if its parent has reaped it; the coupler has to.
  return std::filesystem::exists("/proc/" + std::to_string(pid));
}

bool is_running(int pid) {
  const std::string status = text_of("/proc/" + std::to_string(pid) + "/stat");
  const auto bracket = status.rfind(") ");
  return bracket != std::string::npos && status[bracket + 2] != 'Z';
}

}  // namespace talus::test
