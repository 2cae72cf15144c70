#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/output/source.hpp"
#include "core/scene/sections.hpp"
#include "fem_solver/integration/integrator.hpp"

namespace talus::fem {

/// A column of probes.csv and how its value comes about.
struct ProbeColumn {
  std::string name;  ///< "net_centre.displacement_z_m"
  std::function<double(const Integrator&)> value;
};

/// The columns a scene asks for: displacement and velocity of the nodes its probes name, forces of the parts
/// its probes name, and the sum of the reactions of every support.
/// @pre model and every reference outlive the columns
/// @throws core::ConfigError for a part or quantity that does not exist
std::vector<ProbeColumn> probe_columns(const Model& model, const core::OutputScene& output);

}  // namespace talus::fem
