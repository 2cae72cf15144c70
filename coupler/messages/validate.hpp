#pragma once

#include "coupler/messages/messages.hpp"

/// What a participant says of itself must make sense before anybody computes with it: indices that exist, sizes
/// that fit, names that can stand in a file. Asked by the participant's own library, which names the call, and
/// again by the coupler, which trusts nobody.
namespace talus::coupler {

/// @throws std::invalid_argument with one sentence that names the item and what is expected
void validate(const PublishedSurface& published);
void validate(const Declaration& declaration);

}  // namespace talus::coupler
