#pragma once

#include "interface_mesh/net.hpp"

namespace talus::mesh {

/// Takes the wires along the outline away, and the nodes that hang on nothing then, such as the corners of a
/// square net: for nets that end on ropes which the structure adds itself. Sets lose those nodes; a set that
/// loses all of them goes.
/// @pre the net consists of one part of segments and has the set `rim`
Net without_rim_wires(const Net& net);

}  // namespace talus::mesh
