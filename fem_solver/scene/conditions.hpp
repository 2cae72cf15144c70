#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/fields.hpp"

/// What the scene says about nodes: which ones, held or moved how, loaded and weighed by what.
namespace talus::fem {

/// A table of factors over time, under `key`.
void describe_history(core::Fields& fields, const char* key, std::vector<std::pair<double, double>>& points);

struct BoxScene {
  core::Vector3 low = core::Vector3::Zero();   ///< m
  core::Vector3 high = core::Vector3::Zero();  ///< m
};
void describe(core::Fields& fields, BoxScene& box);

/// One of three ways to name nodes, at the level of whoever needs them.
struct NodeSelection {
  std::string place;                 ///< file and line, for errors found while building
  std::optional<std::string> nodes;  ///< "net.rim", a part's name, or one of `node_sets`
  std::optional<core::Vector3> at;   ///< m
  std::optional<BoxScene> box;
};
void describe_selection(core::Fields& fields, NodeSelection& selection);
void describe(core::Fields& fields, NodeSelection& selection);

struct SupportScene {
  NodeSelection where;
  std::string fix;                                   ///< letters of xyz
  std::optional<core::Vector3> displacement;         ///< m
  std::optional<core::Vector3> velocity;             ///< m/s; from time 0 on
  std::vector<std::pair<double, double>> over_time;  ///< s, factor
};
void describe(core::Fields& fields, SupportScene& support);

struct LoadScene {
  NodeSelection where;
  core::Vector3 force = core::Vector3::Zero();       ///< N on each node
  std::vector<std::pair<double, double>> over_time;  ///< s, factor
};
void describe(core::Fields& fields, LoadScene& load);

struct PointMassScene {
  NodeSelection where;
  double mass = 0;  ///< kg on each node
};
void describe(core::Fields& fields, PointMassScene& mass);

struct InitialDisplacementScene {
  NodeSelection where;
  core::Vector3 displacement = core::Vector3::Zero();  ///< m
};
void describe(core::Fields& fields, InitialDisplacementScene& initial);

struct InitialVelocityScene {
  NodeSelection where;
  core::Vector3 velocity = core::Vector3::Zero();  ///< m/s
};
void describe(core::Fields& fields, InitialVelocityScene& initial);

}  // namespace talus::fem
