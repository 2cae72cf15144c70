#include "coupler/transport/mailbox.hpp"

#include <algorithm>
#include <cstring>

#include "core/errors.hpp"
#include "coupler/transport/signal.hpp"

namespace talus::coupler::transport {
namespace {

/// A channel as one side uses it: what it posts and what it waits for.
struct Line {
  Line(Channel& channel, Side side)
      : outgoing(side == Side::coupler ? channel.command_posted : channel.answer_posted),
        incoming(side == Side::coupler ? channel.answer_posted : channel.command_posted) {}
  void hand_over() const { post(outgoing); }
  void take(const LookAround& look_around) const {
    wait(incoming, look_around);
    look_around(0);  // a post can also mean that the other side gave up
  }

  Signal& outgoing;
  Signal& incoming;
};

}  // namespace

void send(Channel& channel, Side sender, MessageKind kind, std::span<const std::byte> bytes,
          const LookAround& look_around) {
  const Line line(channel, sender);
  Mailbox& box = channel.mailbox;
  std::size_t done = 0;
  do {
    const std::size_t chunk = std::min(bytes.size() - done, box.bytes.size());
    box.kind = static_cast<std::uint32_t>(kind);
    box.total_bytes = bytes.size();
    box.chunk_bytes = static_cast<std::uint32_t>(chunk);
    if (chunk > 0) std::memcpy(box.bytes.data(), bytes.data() + done, chunk);
    done += chunk;
    line.hand_over();
    line.take(look_around);
  } while (done < bytes.size());
}

Message receive(Channel& channel, Side receiver, const LookAround& look_around) {
  const Line line(channel, receiver);
  Message message;
  std::uint64_t total = 0;
  do {
    line.take(look_around);
    const Mailbox& box = channel.mailbox;
    if (message.bytes.empty()) total = box.total_bytes;
    if (box.chunk_bytes > box.bytes.size() || box.chunk_bytes > total - message.bytes.size()) {
      throw core::TransportError({.peer = "the sender of a message",
                                  .waited_for = "a setup message",
                                  .reason = "announced another size than it sent"});
    }
    message.kind = static_cast<MessageKind>(box.kind);
    message.bytes.insert(message.bytes.end(), box.bytes.begin(), box.bytes.begin() + box.chunk_bytes);
    line.hand_over();
  } while (message.bytes.size() < total);
  return message;
}

}  // namespace talus::coupler::transport
