#pragma once

#include "coupler/schemes/exchange.hpp"

namespace talus::coupler {

/// The weak scheme, one call of each side a window:
///
///     particles  --f_n-->  structure  --u_n+1, v_n+1/2-->  particles
///
/// The particles evaluate their contact forces from both sides' positions at t_n, the structure answers to
/// these very forces. So with one step a window on both sides this is the leapfrog of the undivided system,
/// to the last bit where Ω_D is Ω_S ("two masses and a spring, split ..." in serial_explicit_test.cpp). With
/// several steps a window the particles see the boundary where its last velocity takes it; what this lag
/// costs is the difference of the two works of the interface ledger.
struct SerialExplicit {
  void compute(Exchange& exchange, const Window& window) {
    exchange.extrapolate_boundary_end(window);
    exchange.advance_particles(window);
    exchange.forces_to_structure();
    exchange.advance_structure(window);
    exchange.motion_to_boundary();
  }
};

}  // namespace talus::coupler
