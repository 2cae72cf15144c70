#pragma once

#include "fem_solver/homogenise/periodic_net.hpp"
#include "fem_solver/scene/structure_scene.hpp"
#include "interface_mesh/lattice.hpp"

namespace talus::fem {

/// A cell of a net whose wires are all cables of one section; a double twist has two.
PeriodicNet periodic_net(const mesh::Lattice& lattice, const AxialSection& section, double density);

/// The cell of a structure part.
/// @throws core::ConfigError unless the part is a square, rhombic, hexagonal or ring net made of cables
PeriodicNet periodic_net(const PartScene& part);

}  // namespace talus::fem
