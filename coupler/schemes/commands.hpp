#pragma once

#include <optional>

#include "coupler/participant.hpp"
#include "coupler/schemes/window.hpp"

namespace talus::coupler {

/// A command at the start of this window.
Command command_at(const Window& window, Action action);
/// The command to compute this window. @param iteration of a window that may be taken back; absent: of one
/// that is computed once
Command advance(const Window& window, std::optional<int> iteration = {});

}  // namespace talus::coupler
