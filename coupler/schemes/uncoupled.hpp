#pragma once

#include "coupler/schemes/exchange.hpp"

namespace talus::coupler {

/// A scene without an interface: what sides there are advance for themselves, at the same time.
struct Uncoupled {
  void compute(Session& session, const Window& window) {
    const auto peers = session.peers();
    for (Peer* peer : peers) session.post(*peer, advance(window));
    for (Peer* peer : peers) session.wait_answer(*peer);
  }
};

}  // namespace talus::coupler
