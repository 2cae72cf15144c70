#include <cstddef>
#include <cstdint>

#include "core/errors.hpp"
#include "coupler/messages/messages.hpp"

/// Feeds arbitrary bytes to what reads the messages of a participant: its surface, its declaration, its failure.
/// They may be refused with a TransportError and nothing else. What is accepted must come back from its own
/// encoding. The first byte says which message it is to be.
namespace talus::coupler {
namespace {

void read(std::uint8_t kind, ByteView bytes) {
  if (kind % 3 == 0) {
    const PublishedSurface surface = decode_surface(bytes);
    if (encode(decode_surface(encode(surface))) != encode(surface)) __builtin_trap();
  } else if (kind % 3 == 1) {
    const Declaration declaration = decode_declaration(bytes);
    if (encode(decode_declaration(encode(declaration))) != encode(declaration)) __builtin_trap();
  } else {
    try {
      throw_failure(bytes, {.peer = "a participant", .waited_for = "an answer"});
    } catch (const core::ConfigError&) {
    } catch (const core::NumericalError&) {
    } catch (const core::MachineError&) {
    }
  }
}

}  // namespace
}  // namespace talus::coupler

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    talus::coupler::read(data[0], std::as_bytes(std::span(data + 1, size - 1)));
  } catch (const talus::core::TransportError&) {
  }
  return 0;
}
