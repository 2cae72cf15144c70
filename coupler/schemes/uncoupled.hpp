#pragma once

#include "coupler/schemes/exchange.hpp"

namespace talus::coupler {

/// A scene without an interface: what sides there are advance for themselves, at the same time.
struct Uncoupled {
  void compute(Session& session, const Window& window) { session.ask_all(advance(window)); }
};

}  // namespace talus::coupler
