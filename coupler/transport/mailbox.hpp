#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "coupler/transport/layout.hpp"

/// Messages of any size through a channel's mailbox, before the first command. The sender fills a chunk and
/// posts; the receiver takes it and posts back; so at any moment one side owns the mailbox.
namespace talus::coupler::transport {

/// Which semaphore is whose; called each slice of a wait with the seconds slept, throws to give up.
using LookAround = std::function<void(double)>;
enum class Side { coupler, participant };

struct Message {
  MessageKind kind = MessageKind::none;
  std::vector<std::byte> bytes;
};

/// Returns when the other side has taken the whole message.
void send(Channel& channel, Side sender, MessageKind kind, std::span<const std::byte> bytes,
          const LookAround& look_around);
/// Blocks until a whole message is here.
/// @throws TransportError where a chunk claims more bytes than a mailbox holds or the message was announced
/// with
Message receive(Channel& channel, Side receiver, const LookAround& look_around);

}  // namespace talus::coupler::transport
