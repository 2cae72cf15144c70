#include "coupler/transport/layout.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "core/errors.hpp"

namespace talus::coupler::transport {
namespace {

[[noreturn]] void refuse(std::string reason) {
  throw core::TransportError({.peer = "the segment",
                              .waited_for = "a coupling segment",
                              .reason = std::move(reason),
                              .waiter = "this program"});
}

void open_semaphore(sem_t& semaphore, bool between_processes) {
  if (sem_init(&semaphore, between_processes ? 1 : 0, 0) != 0)
    refuse(fmt::format("has no semaphores: {}", std::strerror(errno)));
}

}  // namespace

std::uint64_t layout_hash() noexcept {
  constexpr std::array<std::uint64_t, 19> facts{sizeof(Header),
                                                offsetof(Header, data_bytes),
                                                offsetof(Header, heartbeat),
                                                offsetof(Header, abort_text),
                                                sizeof(Signal),
                                                offsetof(CommandRecord, window),
                                                offsetof(CommandRecord, time),
                                                offsetof(CommandRecord, path),
                                                sizeof(Mailbox),
                                                offsetof(Mailbox, bytes),
                                                sizeof(Channel),
                                                offsetof(Channel, command_posted),
                                                array_count,
                                                offsetof(Channel, answer_posted),
                                                offsetof(Channel, command),
                                                offsetof(Channel, arrays),
                                                sizeof(Control),
                                                offsetof(Channel, failure),
                                                offsetof(Channel, mailbox)};
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, 64 bit
  for (const std::uint64_t fact : facts) {
    hash = (hash ^ fact) * 0x100000001b3;
  }
  return hash;
}

Control& initialise(std::span<std::byte> memory, bool between_processes) {
  auto& control = *new (memory.data()) Control{};
  control.header.layout_hash = layout_hash();
  control.header.control_bytes = sizeof(Control);
  control.header.state = static_cast<std::uint32_t>(RunState::running);
  for (auto& channel : control.channels) {
    open_semaphore(channel.command_posted.raised, between_processes);
    open_semaphore(channel.answer_posted.raised, between_processes);
  }
  return control;
}

Control& checked_control(std::span<std::byte> memory, std::size_t real_bytes) {
  if (memory.size() < sizeof(Header) || real_bytes < sizeof(Header)) {
    refuse(fmt::format("holds {} bytes, too few for a header of {}", real_bytes, sizeof(Header)));
  }
  auto& control = *static_cast<Control*>(static_cast<void*>(memory.data()));
  const Header& header = control.header;
  if (header.magic != magic_number) refuse("is not a Talus coupling segment (wrong magic number)");
  if (header.version != layout_version) {
    refuse(
        fmt::format("has layout version {}, this program speaks version {}", header.version, layout_version));
  }
  if (header.layout_hash != layout_hash()) {
    refuse(fmt::format("has layout hash {:016x}, this program was built with {:016x}", header.layout_hash,
                       layout_hash()));
  }
  if (header.control_bytes != sizeof(Control) || header.channels != role_count ||
      real_bytes < sizeof(Control) || memory.size() < sizeof(Control)) {
    refuse(fmt::format("claims {} bytes of control data where {} are needed and {} are there",
                       header.control_bytes, sizeof(Control), real_bytes));
  }
  return control;
}

std::span<double> checked_array(std::span<std::byte> data, const ArraySlot& slot, std::uint64_t expected) {
  if (slot.count != expected)
    refuse(fmt::format("offers an array of {} values where {} are expected", slot.count, expected));
  if (slot.count == 0) return {};
  // Compared without adding, so that a huge offset cannot wrap around.
  if (slot.offset % array_alignment != 0 || slot.offset > data.size() ||
      slot.count > (data.size() - slot.offset) / sizeof(double)) {
    refuse(fmt::format("places {} values at byte {} of a block of {} bytes", slot.count, slot.offset,
                       data.size()));
  }
  return {static_cast<double*>(static_cast<void*>(data.data() + slot.offset)), slot.count};
}

}  // namespace talus::coupler::transport
