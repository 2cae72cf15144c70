#pragma once

#include "coupler/schemes/exchange.hpp"

namespace talus::coupler {

/// The weak scheme with both sides at work at the same time:
///
///     particles  <- u_n, v_n      structure  <- f_n-1        then both exchange
///
/// Faster where both sides cost the same, and one window less in step: the structure answers to the forces of
/// the window before. The lag shows in the interface ledger.
struct ParallelExplicit {
  void compute(Exchange& exchange, const Window& window) {
    exchange.extrapolate_boundary_end(window);
    exchange.advance_both(window);
    exchange.forces_to_structure();
    exchange.motion_to_boundary();
  }
};

}  // namespace talus::coupler
