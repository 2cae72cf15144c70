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
  std::string watches = {};  ///< the node taken for the point of the scene; empty for columns without
};

/// The columns a scene asks for: displacement and velocity of the nodes its probes name, forces of the parts
/// its probes name, and the sum of the reactions of every support.
/// @pre model and every reference outlive the columns
/// @throws core::ConfigError for a part or quantity that does not exist, and for a point that is further from the
/// nearest node than the longest element there is long
std::vector<ProbeColumn> probe_columns(const Model& model, const core::OutputScene& output);

}  // namespace talus::fem
