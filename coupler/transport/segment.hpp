#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

/// Where the shared blocks live: on the heap for participants that are threads, in shared memory for
/// processes.
namespace talus::coupler::transport {

class Segment {
 public:
  virtual ~Segment() = default;
  /// The control block; never moves.
  virtual std::span<std::byte> control() = 0;
  /// Coupler: makes the data block, zero filled, and maps it. At most once.
  /// @throws MachineError where there is no room for it
  virtual void create_data(std::size_t bytes) = 0;
  /// Participant: maps the data block that the coupler made.
  /// @throws TransportError where it is smaller than `bytes`
  virtual void attach_data(std::size_t bytes) = 0;
  virtual std::span<std::byte> data() = 0;
  /// What the operating system says the control block holds at least.
  virtual std::size_t real_bytes() const = 0;
  virtual std::string name() const = 0;
  /// Takes the name away, so that nothing is left whoever dies; the memory lives as long as somebody has it
  /// mapped. Idempotent.
  virtual void remove_name() noexcept = 0;
};

std::shared_ptr<Segment> create_heap_segment();

/// A new segment of mode 0600 whose name holds 128 random bits and the identity of this process.
/// @throws MachineError where the system gives no shared memory
std::unique_ptr<Segment> create_shared_segment();
/// @throws TransportError if there is no such segment or it is smaller than a control block
std::unique_ptr<Segment> open_shared_segment(const std::string& name);

/// Removes the names of segments whose coupler is gone, which only a coupler killed before all participants
/// joined leaves behind.
/// @returns how many were removed
int remove_stale_segments();

}  // namespace talus::coupler::transport
