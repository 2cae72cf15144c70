#include "core/program/stop.hpp"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace talus::core {
namespace {

constexpr std::array stop_signals{SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2};
/// `timeout --signal=INT` sends the first one twice.
constexpr std::int64_t shortest_between_two = 500'000'000;  // ns

std::atomic<int> requested{0};                // the first signal
std::atomic<std::int64_t> interrupted_at{0};  // ns of the monotonic clock; 0: not by Ctrl-C
const char* stops_when = "";
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

// The functions below run inside of a signal handler: no allocation, no locks.

std::int64_t now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

/// One write, so that it is one piece among what others print.
void say_that_it_stops(int signal) noexcept {
  std::array<char, 200> text{};
  std::size_t size = 0;
  const auto add = [&](const char* words) {
    for (; words != nullptr && *words != 0 && size < text.size(); ++words) text[size++] = *words;
  };
  if (isatty(STDERR_FILENO)) add("\n");  // below the progress line
  add("SIG");
  add(sigabbrev_np(signal));
  add(": stops ");
  add(stops_when);
  add("; Ctrl-C ");
  add(signal == SIGINT ? "again ends it at once\n" : "twice ends it at once\n");
  [[maybe_unused]] const auto ignored = write(STDERR_FILENO, text.data(), size);
}

void end_at_once(int signal) noexcept {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
  raise(signal);
}

extern "C" void on_stop_signal(int signal) {
  const int error = errno;
  if (signal == SIGINT) {
    const std::int64_t before = interrupted_at.load();
    if (before == 0) interrupted_at = now();
    if (before != 0 && now() - before > shortest_between_two) end_at_once(signal);
  }
  int nobody = 0;
  if (requested.compare_exchange_strong(nobody, signal)) say_that_it_stops(signal);
  errno = error;
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

}  // namespace

void watch_stop_signals(const char* when) {
  requested = 0;
  interrupted_at = 0;
  stops_when = when;
  for (const int signal : stop_signals)
    if (signal != SIGHUP || !is_ignored(signal)) handle(signal, on_stop_signal);
  handle(SIGPIPE, SIG_IGN);
}

bool stop_requested() noexcept {
  return requested.load(std::memory_order_relaxed) != 0;
}

std::string stop_reason() {
  const int signal = requested;
  return signal == 0 ? "" : std::string("stopped by SIG") + sigabbrev_np(signal);
}

void ignore_stop_signals() {
  for (const int signal : stop_signals) handle(signal, SIG_IGN);
  handle(SIGPIPE, SIG_IGN);
}

}  // namespace talus::core
