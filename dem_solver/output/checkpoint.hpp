#pragma once

#include <filesystem>
#include <functional>

#include "core/output/checkpoint.hpp"
#include "dem_solver/solver.hpp"

/// The whole state of a particle run in an HDF5 file: a run that continues from it gives the same bits as one
/// that was never interrupted. Neighbour lists and the order of the spheres are part of it, since they fix
/// the order of sums.
namespace talus::dem {

/// Writes or reads what a run remembers besides its solver.
using ArchiveMore = std::function<void(core::StateArchive&)>;

/// Replaces the file in one step: a reader sees the old checkpoint or the new one, never a part.
/// @throws std::runtime_error where it cannot be written
void write_checkpoint(const ParticleSolver& solver, const std::filesystem::path& path,
                      const ArchiveMore& more = {});

/// Replaces the state of a solver that was made from the same scene.
/// @throws ConfigError where the file is no checkpoint of this scene's spheres
void read_checkpoint(ParticleSolver& solver, const std::filesystem::path& path, const ArchiveMore& more = {});

}  // namespace talus::dem
