#pragma once

#include <semaphore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

/// The memory that coupler and participants share, byte for byte. One block of control data of fixed size
/// (header, one channel a role), and one block of arrays whose size is known once every participant has said
/// what it publishes. Both transports, threads in one process and shared memory between processes, use
/// exactly this layout.
///
/// Every struct is plain data of a fixed size: a participant built from other sources either agrees on all of
/// it (`layout_hash`) or is refused at join. Values that two processes touch at the same time are accessed
/// through std::atomic_ref.
namespace talus::coupler::transport {

inline constexpr std::uint64_t magic_number = 0x314C505553554C54;  // "TLUSUPL1"
inline constexpr std::uint32_t layout_version = 7;
inline constexpr std::size_t role_count = 2;
inline constexpr std::size_t array_alignment = 64;

/// What the coupler is doing, in Header::state.
enum class RunState : std::uint32_t { running = 1, aborted = 2, ended = 3 };

/// What has become of a participant, in Channel::state.
enum class ChannelState : std::uint32_t { unused = 0, awaited = 1, joined = 2, failed = 3, left = 4 };

/// What the bytes of a mailbox are.
enum class MessageKind : std::uint32_t { none = 0, surface = 1, surface_request = 2, declaration = 3 };

/// Arrays of the data block that a channel owns. `displacement` and `velocity` are those at the window's
/// start on the particle side. `lost` has one value a cell, the others three a node.
enum class ArrayName : std::uint32_t {
  force,
  displacement,
  velocity,
  end_displacement,
  end_velocity,
  free_velocity,
  moved_displacement,
  moved_velocity,
  lost,
  outputs,
  count
};
inline constexpr std::size_t array_count = static_cast<std::size_t>(ArrayName::count);

struct Header {
  std::uint64_t magic = magic_number;
  std::uint32_t version = layout_version;
  std::uint32_t channels = role_count;
  std::uint64_t layout_hash = 0;
  std::uint64_t control_bytes = 0;
  std::uint64_t data_bytes = 0;  ///< 0 until the data block exists
  std::int64_t coupler_pid = 0;  ///< 0: coupler and participants are threads of one process
  std::uint64_t coupler_start =
      0;  ///< clock ticks since boot, so that a reused pid is not mistaken for the coupler
  std::uint64_t heartbeat = 0;  ///< counts while the coupler lives; a stopped coupler stops counting
  std::uint32_t state = 0;      ///< RunState
  std::uint32_t abort_text_bytes = 0;
  std::array<char, 1984> abort_text{};  ///< who ended the run and why, for the other participants' messages
};

struct CommandRecord {
  std::uint32_t action = 0;
  std::uint32_t fields = 0;
  std::int64_t window = -1;
  std::int32_t iteration = 0;
  std::uint32_t tentative = 0;
  double time = 0;
  double length = 0;
  double regular_length = 0;
  double force_shift = 0;
  std::array<char, 1024> path{};  ///< ends with 0
};

struct ArraySlot {
  std::uint64_t offset = 0;  ///< bytes from the start of the data block, a multiple of array_alignment
  std::uint64_t count = 0;   ///< doubles
};

/// One message at a time, cut into chunks that are handed over one after the other.
struct Mailbox {
  std::uint32_t kind = 0;  ///< MessageKind
  std::uint32_t chunk_bytes = 0;
  std::uint64_t total_bytes = 0;
  std::array<std::byte, 65536> bytes{};
};

/// One side's word to the other that it has done its part.
struct Signal {
  sem_t raised;
  std::int64_t posted_at = 0;  ///< ns of the monotonic clock; released by the side that posts, acquired by
                               ///< the side that waits
};

struct alignas(array_alignment) Channel {
  std::uint32_t state = 0;  ///< ChannelState
  std::uint32_t failure_bytes = 0;
  std::int64_t pid = 0;
  std::uint64_t start_time = 0;  ///< clock ticks since boot
  Signal command_posted, answer_posted;
  double work = 0;  ///< J; done on this side's surface since time 0. Written by the participant while it
                    ///< answers, else by the coupler
  double window_work = 0;  ///< J; on this side's surface in the window just computed, where `books_work`
  std::uint64_t books_work = 0;        ///< not 0: the participant told it in its last answer to `advance`
  std::int64_t force_evaluations = 0;  ///< since time 0, if the participant tells; written while it answers
  CommandRecord command;
  std::array<ArraySlot, array_count> arrays{};
  std::array<std::byte, 32768> failure{};  ///< CBOR of why the participant cannot go on
  Mailbox mailbox;
};

struct alignas(4096) Control {
  Header header;
  std::array<Channel, role_count> channels;
};

static_assert(std::is_trivially_copyable_v<Control> && std::is_standard_layout_v<Control>);
static_assert(sizeof(Header) == 2056 && sizeof(CommandRecord) == 1080 && sizeof(ArraySlot) == 16 &&
              sizeof(Mailbox) == 65552);
static_assert(sizeof(Signal) == 40 && sizeof(Channel) % array_alignment == 0 && sizeof(Control) % 4096 == 0);

/// Digest of sizes and offsets of everything above.
std::uint64_t layout_hash() noexcept;

/// Puts an empty control block with initialised semaphores into `memory`.
/// @pre memory.size() >= sizeof(Control), aligned to 4096
Control& initialise(std::span<std::byte> memory, bool between_processes);

/// The control block in `memory`, after every check that needs no trust in its content.
/// @param real_bytes what the operating system says the object holds
/// @throws TransportError naming the first check that fails: too small, magic, version, layout hash, lying
/// size.
Control& checked_control(std::span<std::byte> memory, std::size_t real_bytes);

/// The array behind a slot, after checking that it lies inside `data`.
/// @throws TransportError if it does not, or is not aligned, or does not hold `expected` doubles.
std::span<double> checked_array(std::span<std::byte> data, const ArraySlot& slot, std::uint64_t expected);

}  // namespace talus::coupler::transport
