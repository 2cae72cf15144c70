#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/program/log.hpp"
#include "coupler/session/heartbeat.hpp"
#include "coupler/session/patience.hpp"
#include "coupler/session/peer.hpp"
#include "coupler/transport/segment.hpp"

namespace talus::coupler {

/// Thrown out of a wait before the first window when the user wants to stop.
struct Interrupted {};

/// Whether each participant has interface arrays of its own, or all look at the same. Output values are each
/// one's own.
enum class ArraySets { one_each, one };

struct SessionOptions {
  double timeout = 300;      ///< s that a participant may take for an answer, unless its peer says otherwise
  double join_timeout = 60;  ///< s from the start until a participant has joined; likewise
  double grace = 1;          ///< s that participants get to leave before they are asked to by SIGTERM
  std::function<bool()> interrupted = [] { return false; };
};

/// The coupler's end of a segment: who takes part, what they are told, and whether they are still there. Its
/// end is the end of every participant: told, waited for, killed if need be, and reaped.
class Session {
 public:
  Session(std::shared_ptr<transport::Segment> segment, SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Awaits a participant in this role, which somebody else starts.
  Peer& await(Role role);
  /// Starts a program that is to join in this role; its command without the arguments that say where to.
  Peer& launch(Role role, const launch::Program& program);
  Peer* find(Role role);
  std::vector<Peer*> peers();
  std::string segment_name() const { return segment_->name(); }

  /// Blocks until everybody awaited has joined, then takes the segment's name away.
  /// @throws TransportError naming who did not, Interrupted
  void wait_joined();
  /// The next setup message of a peer. @throws what the peer failed with, TransportError, Interrupted
  transport::Message receive(Peer& peer, const std::string& what);
  void send(Peer& peer, transport::MessageKind kind, ByteView bytes);
  /// Makes the data block, once the channels' array sizes are set (`request_array`).
  void create_arrays(ArraySets sets = ArraySets::one_each);
  static void request_array(Peer& peer, transport::ArrayName name, std::size_t count);

  // From here on in windows.
  void post(Peer& peer, const Command& command);
  /// Sleeps until the peer has answered the command posted last. @throws TransportError, or what the peer
  /// failed with
  void wait_answer(Peer& peer);
  void ask(Peer& peer, const Command& command) {
    post(peer, command);
    wait_answer(peer);
  }
  /// The same of everybody, at the same time.
  void ask_all(const Command& command) {
    for (const auto& peer : peers_) post(*peer, command);
    for (const auto& peer : peers_) wait_answer(*peer);
  }
  std::int64_t window() const { return window_; }
  /// Who says it when a wait becomes long: "waits 20 s for structure (fem_solver, pid 12): the answer to
  /// 'advance' (computing, 98 % CPU)".
  void tell_waits_to(std::function<void(const std::string&)> tell) { tell_wait_ = std::move(tell); }

  /// Tells everybody to leave and waits until they did. @throws TransportError if one of them ends badly
  void finish();
  /// Tells everybody why the run ends; participants that do not leave within the grace are sent SIGTERM, then
  /// SIGKILL. Idempotent.
  void abort(const std::string& why) noexcept;

 private:
  /// Whose end matters: while joining everybody's, but a scene that one of them refuses may be refused by
  /// others too, so they are heard first; during setup each in turn; from the first window on everybody's.
  enum class Phase { joining, setting_up, running };
  struct Waiting {
    Peer& peer;
    std::string what;
    double limit = 0;  ///< s
  };
  void look_around(const Waiting& waiting, double seconds);
  void check_alive(const Waiting& waiting);
  bool matters(Peer& peer, const Waiting& waiting) const;
  transport::LookAround looking(Peer& peer, const std::string& what);
  bool everybody_left(double seconds);

  std::shared_ptr<transport::Segment> segment_;
  SessionOptions options_;
  transport::Control& control_;
  Heartbeat heartbeat_;
  Patience patience_;
  std::function<void(const std::string&)> tell_wait_ = core::log_info;
  std::vector<std::unique_ptr<Peer>> peers_;
  Phase phase_ = Phase::joining;
  std::int64_t window_ = -1;
  Action action_ = Action::finish;
  bool over_ = false;
};

}  // namespace talus::coupler
