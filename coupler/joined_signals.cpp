#include "coupler/joined_signals.hpp"

#include <unistd.h>

#include <atomic>

#include "core/errors.hpp"
#include "coupler/transport/layout.hpp"
#include "coupler/transport/signal.hpp"

namespace talus::coupler {
namespace {

std::atomic<const std::uint32_t*> state_of_run{nullptr};
static_assert(std::atomic<const std::uint32_t*>::is_always_lock_free);

extern "C" void on_signal_of_joined(int) {
  const std::uint32_t* state = state_of_run.load();
  if (state != nullptr && transport::load(*state) != static_cast<std::uint32_t>(transport::RunState::running))
    _exit(static_cast<int>(core::ExitCode::transport));
}

bool is_own(const struct sigaction& action) {
  return action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
}

}  // namespace

SignalsLeftToCoupler::SignalsLeftToCoupler(const std::uint32_t& run_state) {
  state_of_run = &run_state;
  struct sigaction action {};
  action.sa_handler = on_signal_of_joined;
  action.sa_flags = static_cast<int>(SA_RESTART);
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    sigaction(signals_[i], nullptr, &before_[i]);
    if (!is_own(before_[i])) sigaction(signals_[i], &action, nullptr);
  }
}

SignalsLeftToCoupler::~SignalsLeftToCoupler() {
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (!is_own(before_[i])) sigaction(signals_[i], &before_[i], nullptr);
  state_of_run = nullptr;
}

}  // namespace talus::coupler
