#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "coupler/launch/child.hpp"
#include "coupler/messages/messages.hpp"
#include "coupler/messages/output_arrays.hpp"
#include "coupler/participant.hpp"
#include "coupler/transport/layout.hpp"
#include "coupler/transport/mailbox.hpp"

namespace talus::coupler {

/// A participant as the coupler sees it: a channel, and the process behind it where there is one.
class Peer {
 public:
  Peer(Role role, transport::Channel& channel);

  Role role() const { return role_; }
  std::string label() const;  ///< "structure (fem_solver, pid 1234)"
  /// The process that computes: the one that joined, else the one that was started; 0: a thread of this process.
  pid_t pid() const;
  void set_program(std::string name) { program_ = std::move(name); }
  void set_child(launch::Child child) { child_.emplace(std::move(child)); }
  /// s that it may take for an answer, and from the start until it has joined.
  struct Patience {
    double answer = 0, join = 0;
  };
  void set_patience(const Patience& patience) { patience_ = patience; }
  const Patience& patience() const { return patience_; }
  launch::Child* child() { return child_ ? &*child_ : nullptr; }
  transport::Channel& channel() { return channel_; }

  /// Why no answer will ever come, or nothing while one still may.
  std::optional<std::string> lost();
  bool has_failed() const;
  [[noreturn]] void throw_its_failure(const FailureContext& context) const;
  /// Called once it has joined: from now on its own process is watched too, be it a child or not.
  void watch_process();
  bool process_ended();
  void ask_to_end();  ///< SIGTERM, to its whole process group where it is a child
  void kill();        ///< SIGKILL, likewise

  /// Interface and output arrays; valid once the data block exists.
  std::span<double> array(transport::ArrayName name) const { return arrays_[static_cast<std::size_t>(name)]; }
  void set_arrays(std::span<std::byte> data);
  /// Done on this side's surface since time 0, J; the coupler's to change between an answer and the next
  /// command.
  double& work() const { return channel_.work; }
  /// J; of the window computed last, from the peer's own ledger; nothing where it keeps none.
  std::optional<double> window_work() const {
    return channel_.books_work != 0 ? std::optional(channel_.window_work) : std::nullopt;
  }
  /// Windows it was asked to compute since the start, those taken back included, and how often it evaluated
  /// its forces for them (0 where it does not tell).
  std::int64_t calls() const { return calls_; }
  void count_call() { ++calls_; }
  std::int64_t force_evaluations() const { return channel_.force_evaluations; }
  const Declaration& declaration() const { return declaration_; }
  const OutputArrays& output_arrays() const { return output_arrays_; }
  void set_declaration(Declaration declaration);

 private:
  Role role_;
  transport::Channel& channel_;
  std::string program_;
  Patience patience_;
  std::optional<launch::Child> child_;
  transport::ProcessHandle process_;
  std::array<std::span<double>, transport::array_count> arrays_;
  Declaration declaration_;
  OutputArrays output_arrays_;
  std::int64_t calls_ = 0;
};

const char* name_of(Role role);
/// "advance", "report": for messages.
const char* name_of(Action action);

}  // namespace talus::coupler
