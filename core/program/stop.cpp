#include "core/program/stop.hpp"

#include <csignal>

namespace talus::core {
namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void on_stop_signal(int) {
  requested = 1;
}

}  // namespace

void watch_stop_signals() {
  requested = 0;
  struct sigaction action {};
  action.sa_handler = on_stop_signal;
  action.sa_flags =
      static_cast<int>(SA_RESETHAND);  // the second signal does what it does by default: it kills
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() noexcept {
  return requested != 0;
}

void ignore_interrupts() {
  std::signal(SIGINT, SIG_IGN);
}

}  // namespace talus::core
