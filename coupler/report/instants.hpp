#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/output/field_reader.hpp"

namespace talus::report {

/// Frames of a result that a reader of its page looks for.
struct Instants {
  std::optional<std::int64_t> peak;     ///< where the structure is displaced most
  std::optional<std::int64_t> contact;  ///< the first with a contact force on the boundary
};

/// @pre there is a frame
Instants instants_of(const core::FieldReader& fields);

/// At most so many frames, in order: evenly spaced, with the first, the last and those of the instants among them.
/// @pre most >= 4 or all frames
std::vector<std::int64_t> chosen_frames(std::int64_t frames, std::int64_t most, const Instants& instants);

}  // namespace talus::report
