#include "coupler/session/peer.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "coupler/transport/signal.hpp"

namespace talus::coupler {

using namespace transport;

const char* name_of(Role role) {
  return role == Role::structure ? "structure" : "particles";
}

const char* name_of(Action action) {
  switch (action) {
    case Action::advance:
      return "advance";
    case Action::save_state:
      return "save_state";
    case Action::restore_state:
      return "restore_state";
    case Action::report:
      return "report";
    case Action::write_checkpoint:
      return "write_checkpoint";
    case Action::read_checkpoint:
      return "read_checkpoint";
    case Action::finish:
      return "finish";
  }
  return "?";
}

Peer::Peer(Role role, Channel& channel) : role_(role), channel_(channel) {
  store(channel_.state, static_cast<std::uint32_t>(ChannelState::awaited));
}

std::string Peer::label() const {
  const std::string program = program_.empty() ? "" : program_ + ", ";
  const pid_t pid = child_ ? child_->pid() : static_cast<pid_t>(channel_.pid);
  return pid > 0 ? fmt::format("{} ({}pid {})", name_of(role_), program, pid) : std::string(name_of(role_));
}

pid_t Peer::pid() const {
  if (channel_.pid > 0) return channel_.pid == getpid() ? 0 : static_cast<pid_t>(channel_.pid);
  return child_ ? child_->pid() : 0;
}

bool Peer::has_failed() const {
  return load(channel_.state) == static_cast<std::uint32_t>(ChannelState::failed);
}

void Peer::throw_its_failure(const FailureContext& context) const {
  const auto bytes = std::min<std::size_t>(channel_.failure_bytes, channel_.failure.size());
  throw_failure(ByteView(channel_.failure).first(bytes), context);
}

std::optional<std::string> Peer::lost() {
  if (child_) {
    if (const auto status = child_->status()) return status->text();
  }
  if (!process_.alive()) return "died";
  if (load(channel_.state) != static_cast<std::uint32_t>(ChannelState::left)) return std::nullopt;
  // It left on its own; its exit status says more where it is a child.
  constexpr double until_the_process_ends = 0.5;
  const auto status = child_ ? child_->wait_end(until_the_process_ends) : std::nullopt;
  return status ? status->text() : "left the run";
}

void Peer::watch_process() {
  if (channel_.pid > 0 && channel_.pid != this_process().pid) {
    process_ = ProcessHandle({.pid = static_cast<pid_t>(channel_.pid), .start = channel_.start_time});
  }
}

bool Peer::process_ended() {
  return child_ ? child_->status().has_value() && !(process_.pid() > 0 && process_.alive())
                : process_.pid() == 0 || !process_.alive();
}

void Peer::ask_to_end() {
  process_.send_signal(SIGTERM);
  process_.send_signal(SIGCONT);
  if (child_) child_->ask_to_end();
}

void Peer::kill() {
  process_.send_signal(SIGKILL);
  if (child_) child_->kill();
}

void Peer::set_arrays(std::span<std::byte> data) {
  for (std::size_t i = 0; i < array_count; ++i)
    arrays_[i] = checked_array(data, channel_.arrays[i], channel_.arrays[i].count);
}

void Peer::set_declaration(Declaration declaration) {
  declaration_ = std::move(declaration);
  output_arrays_ = OutputArrays(declaration_.outputs);
}

}  // namespace talus::coupler
