#include "coupler/session/patience.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

using namespace talus::coupler;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// A process that computes or sleeps, until the end of the test.
class Other {
 public:
  explicit Other(bool busy) : pid_(fork()) {
    if (pid_ != 0) return;
    for (volatile bool on = busy; on;) {
    }
    for (;;) pause();
  }
  ~Other() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Other(const Other&) = delete;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

}  // namespace

TEST_CASE("a process that computes and one that is stuck are told apart by the time they used") {
  const Other busy(true), idle(false);
  Patience of_busy, of_idle;
  constexpr double from = 1, to = 1.7;  // s
  of_busy.look(busy.pid(), from);
  of_idle.look(idle.pid(), from);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  of_busy.look(busy.pid(), to);
  of_idle.look(idle.pid(), to);
  CHECK_THAT(of_busy.condition(), StartsWith("computing, ") && Contains(" % CPU"));
  CHECK(of_idle.condition() == "stuck: sleeps, 0 % CPU");
  kill(idle.pid(), SIGSTOP);
  waitpid(idle.pid(), nullptr, WUNTRACED);
  CHECK(of_idle.condition() == "is stopped");
}

TEST_CASE("a long wait is told after 10 s, then ever more rarely, and anew in each wait") {
  Patience patience;
  std::vector<double> told;
  for (int wait = 0; wait < 2; ++wait)
    for (double seconds = 0.25; seconds < 100; seconds += 0.25) {
      patience.look(0, seconds);
      if (patience.time_to_tell()) told.push_back(seconds);
    }
  CHECK(told == std::vector<double>{10, 20, 40, 80, 10, 20, 40, 80});
  CHECK(patience.condition().empty());  // a thread of this process
}
