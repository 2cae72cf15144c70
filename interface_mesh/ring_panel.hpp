#pragma once

#include "interface_mesh/net.hpp"
#include "interface_mesh/panel.hpp"

namespace talus::mesh {

/// Rings of a panel as the polygons through the points where they touch: a node between each two neighbours, and at
/// the panel's rim the outer end of each ring there.
///
///          +--N--+--N--+      +  of the panel
///          W  o  o  o  E      o  a ring: E, N, W, S, back to E; four segments, one behind the other
///          +--S--+--S--+
///
/// Only whole rings: in a rectangle as many as go into it best, their distance stretched or pressed to fit
/// (misfit() says by how much); in any other outline those that are inside. Node sets are those of other nets, but no
/// node stands at a corner: `corners` are the nodes next to each, on both edges, and edges have no corners.
/// @throws core::ConfigError if no ring is inside the panel
Net ring_polygons(double diameter, const Panel& panel);

/// How far a rectangle is from a whole number of rings, as a share of its length or width, whichever is worse; 0 for
/// other outlines.
double misfit(double diameter, const Panel& panel);

}  // namespace talus::mesh
