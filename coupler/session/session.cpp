#include "coupler/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "coupler/transport/signal.hpp"

namespace talus::coupler {

using namespace transport;

namespace {

std::string in_brackets(const std::string& condition) {
  return condition.empty() ? "" : " (" + condition + ")";
}

/// ". The outputs of the structure take 61.2 MB, its interface 0.3 MB": for who wonders what is so large.
std::string what_needs_room(const std::vector<std::unique_ptr<Peer>>& peers) {
  std::string text;
  for (const auto& peer : peers) {
    const auto& slots = peer->channel().arrays;
    const std::uint64_t outputs = slots[static_cast<std::size_t>(ArrayName::outputs)].count;
    std::uint64_t all = 0;
    for (const ArraySlot& slot : slots) all += slot.count;
    const auto megabytes = [](std::uint64_t values) {
      return 1e-6 * sizeof(double) * static_cast<double>(values);
    };
    text += fmt::format(". The outputs of the {} (tables, fields) take {:.3g} MB, its interface {:.3g} MB",
                        name_of(peer->role()), megabytes(outputs), megabytes(all - outputs));
  }
  return text;
}

}  // namespace

Session::Session(std::shared_ptr<Segment> segment, SessionOptions options)
    : segment_(std::move(segment)),
      options_(std::move(options)),
      control_(initialise(segment_->control(), segment_->name().starts_with("talus-"))),
      heartbeat_(control_.header.heartbeat) {
  if (!segment_->name().starts_with("talus-")) return;
  const ProcessIdentity self = this_process();
  control_.header.coupler_start = self.start;
  control_.header.coupler_pid = self.pid;
  ask_for_early_turns();
}

Session::~Session() {
  abort("it did not say why");
}

Peer& Session::await(Role role) {
  peers_.push_back(std::make_unique<Peer>(role, control_.channels[static_cast<std::size_t>(role)]));
  peers_.back()->set_patience({.answer = options_.timeout, .join = options_.join_timeout});
  return *peers_.back();
}

Peer& Session::launch(Role role, const launch::Program& program) {
  Peer& peer = await(role);
  launch::Program full = program;
  full.command.insert(full.command.end(), {"--join", segment_->name()});
  peer.set_program(program.name);
  peer.set_child(launch::Child(full));
  return peer;
}

Peer* Session::find(Role role) {
  const auto found =
      std::find_if(peers_.begin(), peers_.end(), [role](const auto& peer) { return peer->role() == role; });
  return found == peers_.end() ? nullptr : found->get();
}

std::vector<Peer*> Session::peers() {
  std::vector<Peer*> all;
  for (const auto& peer : peers_) all.push_back(peer.get());
  return all;
}

bool Session::matters(Peer& peer, const Waiting& waiting) const {
  switch (phase_) {
    case Phase::joining:
      return !peer.has_failed();
    case Phase::setting_up:
      return &peer == &waiting.peer;
    case Phase::running:
      break;
  }
  return true;
}

void Session::check_alive(const Waiting& waiting) {
  for (const auto& peer : peers_) {
    if (!matters(*peer, waiting)) continue;
    // Asked before the failure is looked at: a peer that failed and left since then is found to have failed.
    const auto reason = peer->lost();
    if (peer->has_failed()) {
      peer->throw_its_failure({.peer = peer->label(), .waited_for = waiting.what, .window = window_});
    }
    if (reason) {
      throw core::TransportError(
          {.peer = peer->label(), .waited_for = waiting.what, .window = window_, .reason = *reason});
    }
  }
}

void Session::look_around(const Waiting& waiting, double seconds) {
  check_alive(waiting);
  if (phase_ != Phase::running && options_.interrupted()) throw Interrupted{};
  patience_.look(waiting.peer.pid(), seconds);
  if (patience_.time_to_tell())
    tell_wait_(fmt::format("waits {:.0f} s for {}: {}{}", seconds, waiting.peer.label(), waiting.what,
                           in_brackets(patience_.condition())));
  if (seconds <= waiting.limit) return;
  throw core::TransportError({.peer = waiting.peer.label(),
                              .waited_for = waiting.what,
                              .window = window_,
                              .reason = fmt::format("gave no answer for {:g} s{}", waiting.limit,
                                                    in_brackets(patience_.condition()))});
}

void Session::wait_joined() {
  for (const auto& peer : peers_) {
    const Waiting waiting{.peer = *peer, .what = "it to join", .limit = peer->patience().join};
    wait(peer->channel().answer_posted, [&](double seconds) { look_around(waiting, seconds); });
    check_alive(waiting);
    peer->watch_process();
  }
  segment_->remove_name();
  phase_ = Phase::setting_up;
}

LookAround Session::looking(Peer& peer, const std::string& what) {
  return [this, &peer, what](double seconds) {
    look_around({.peer = peer, .what = what, .limit = peer.patience().answer}, seconds);
  };
}

Message Session::receive(Peer& peer, const std::string& what) {
  return transport::receive(peer.channel(), Side::coupler, looking(peer, what));
}

void Session::send(Peer& peer, MessageKind kind, ByteView bytes) {
  transport::send(peer.channel(), Side::coupler, kind, bytes, looking(peer, "its surface to be taken"));
}

void Session::request_array(Peer& peer, ArrayName name, std::size_t count) {
  peer.channel().arrays[static_cast<std::size_t>(name)].count = count;
}

void Session::create_arrays(ArraySets sets) {
  std::uint64_t bytes = 0;
  const auto place = [&bytes](ArraySlot& slot) {
    slot.offset = bytes;
    bytes += (slot.count * sizeof(double) + array_alignment - 1) / array_alignment * array_alignment;
  };
  for (const auto& peer : peers_) {
    auto& slots = peer->channel().arrays;
    if (sets == ArraySets::one && peer != peers_.front()) {
      ArraySlot& own_outputs = slots[static_cast<std::size_t>(ArrayName::outputs)];
      const auto output_values = own_outputs.count;
      slots = peers_.front()->channel().arrays;
      own_outputs.count = output_values;
      place(own_outputs);
    } else {
      std::for_each(slots.begin(), slots.end(), place);
    }
  }
  phase_ = Phase::running;
  try {
    segment_->create_data(bytes);
  } catch (const core::MachineError& error) {
    throw core::MachineError(error.what() + what_needs_room(peers_));
  }
  control_.header.data_bytes = bytes;
  for (const auto& peer : peers_) peer->set_arrays(segment_->data());
}

void Session::post(Peer& peer, const Command& command) {
  CommandRecord& record = peer.channel().command;
  if (command.path.size() >= record.path.size()) {
    throw core::UsageError(fmt::format("a checkpoint's path may have {} bytes, '{}' has more",
                                       record.path.size() - 1, command.path));
  }
  record.action = static_cast<std::uint32_t>(command.action);
  record.fields = command.fields ? 1 : 0;
  record.window = command.window;
  record.iteration = command.iteration;
  record.tentative = command.tentative ? 1 : 0;
  record.time = command.time;
  record.length = command.length;
  record.regular_length = command.regular_length;
  record.force_shift = command.force_shift;
  std::memcpy(record.path.data(), command.path.c_str(), command.path.size() + 1);
  window_ = command.window;
  action_ = command.action;
  if (command.action == Action::advance) peer.count_call();
  transport::post(peer.channel().command_posted);
}

void Session::wait_answer(Peer& peer) {
  Channel& channel = peer.channel();
  wait(channel.answer_posted, [&](double seconds) {
    look_around({.peer = peer,
                 .what = fmt::format("the answer to '{}'", name_of(action_)),
                 .limit = peer.patience().answer},
                seconds);
  });
  if (load(channel.state) != static_cast<std::uint32_t>(ChannelState::joined)) {
    check_alive({.peer = peer, .what = fmt::format("the answer to '{}'", name_of(action_))});
  }
}

bool Session::everybody_left(double seconds) {
  const auto left = [](const std::unique_ptr<Peer>& peer) {
    // A thread of this process has no process of its own; its channel says that it left. One that never
    // joined need not leave.
    const auto state = static_cast<ChannelState>(load(peer->channel().state));
    const bool is_process =
        peer->child() != nullptr || (peer->channel().pid > 0 && peer->channel().pid != this_process().pid);
    return is_process ? peer->process_ended() : state != ChannelState::joined;
  };
  for (double waited = 0;; waited += slice_seconds / 10) {
    if (std::all_of(peers_.begin(), peers_.end(), left)) return true;
    if (waited >= seconds) return false;
    timespec pause{.tv_sec = 0, .tv_nsec = static_cast<long>(slice_seconds / 10 * 1e9)};
    nanosleep(&pause, nullptr);
  }
}

void Session::finish() {
  for (const auto& peer : peers_) post(*peer, {.action = Action::finish, .window = window_});
  double longest = 0;
  for (const auto& peer : peers_) longest = std::max(longest, peer->patience().answer);
  if (!everybody_left(longest)) {
    for (const auto& peer : peers_) {
      if (peer->process_ended()) continue;
      throw core::TransportError(
          {.peer = peer->label(),
           .waited_for = "it to leave",
           .window = window_,
           .reason = fmt::format("did not leave within {:g} s of the command to finish", longest)});
    }
  }
  over_ = true;
  store(control_.header.state, static_cast<std::uint32_t>(RunState::ended));
  for (const auto& peer : peers_) {
    const auto status = peer->child() != nullptr ? peer->child()->status() : std::nullopt;
    if (status && (status->code != 0 || status->signal != 0)) {
      throw core::TransportError(
          {.peer = peer->label(), .waited_for = "it to leave", .window = window_, .reason = status->text()});
    }
  }
}

void Session::abort(const std::string& why) noexcept {
  if (over_) return;
  over_ = true;
  Header& header = control_.header;
  const auto bytes = std::min(why.size(), header.abort_text.size());
  std::copy_n(why.begin(), bytes, header.abort_text.begin());
  store(header.abort_text_bytes, static_cast<std::uint32_t>(bytes));
  store(header.state, static_cast<std::uint32_t>(RunState::aborted));
  for (const auto& peer : peers_) transport::post(peer->channel().command_posted);
  segment_->remove_name();
  if (!everybody_left(options_.grace)) {
    for (const auto& peer : peers_)
      if (!peer->process_ended()) peer->ask_to_end();
    everybody_left(launch::patience);
  }
  for (const auto& peer : peers_) {
    if (!peer->process_ended()) peer->kill();
    if (peer->child() != nullptr) peer->child()->end();
  }
}

}  // namespace talus::coupler
