#pragma once

#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "coupler/participant.hpp"
#include "interface_mesh/surface.hpp"

/// What participants and coupler tell each other before the first window and at a failure, as CBOR (RFC 8949)
/// so that programs in other languages can read it. Arrays travel as CBOR byte strings holding the machine's
/// own numbers.
namespace talus::coupler {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

struct PublishedSurface {
  mesh::Surface surface;
  std::vector<double> node_masses;  ///< kg, one a node
};
Bytes encode(const PublishedSurface& published);
Bytes encode(const Declaration& declaration);
/// The kind of the error and everything needed to make the same error again.
Bytes encode_failure(const std::exception& error);

/// @param sender for the error's text
/// @throws TransportError where the bytes are not such a message, or what it says makes no sense (validate.hpp)
PublishedSurface decode_surface(ByteView bytes, const std::string& sender = "a participant");
Declaration decode_declaration(ByteView bytes, const std::string& sender = "a participant");

/// Who failed and when, for errors whose own text does not say it.
struct FailureContext {
  std::string peer;
  std::string waited_for;
  std::int64_t window = -1;
};
/// Throws the participant's error in the coupler: ConfigError and NumericalError as they were, errors of the
/// machine as MachineError, anything else as a TransportError; the last two name the participant.
[[noreturn]] void throw_failure(ByteView bytes, const FailureContext& context);

}  // namespace talus::coupler
