#include "fem_solver/scene/node_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

std::string known_names(const Model& model) {
  std::string names;
  for (const auto& [name, nodes] : model.node_sets)
    if (nodes.size() > 1 || model.node_sets.size() < 20) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::string coordinates(const Vector3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z());
}

/// Points written by hand are rarely exact: within a millionth of the structure's extent they mean the node.
Index node_at(const Model& model, const std::string& place, const Vector3& point) {
  const auto x = Eigen::Matrix3Xd::Map(model.reference.data(), 3, model.nodes());
  Eigen::Index nearest = 0;
  const double distance = (x.colwise() - point).colwise().norm().minCoeff(&nearest);
  const double extent = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  if (distance > 1e-6 * extent)
    throw core::ConfigError(fmt::format("{}: at: no node at {}; the nearest is {}, {:.4g} m away", place,
                                        coordinates(point), node_name(model, static_cast<Index>(nearest)),
                                        distance));
  return static_cast<Index>(nearest);
}

std::vector<Index> nodes_in(const Model& model, const std::string& place, const BoxScene& box) {
  std::vector<Index> found;
  for (Index i = 0; i < model.nodes(); ++i) {
    const Eigen::Array3d x = model.position(i);
    if ((x >= box.low.array()).all() && (x <= box.high.array()).all()) found.push_back(i);
  }
  if (found.empty())
    throw core::ConfigError(fmt::format("{}: box: no node between {} and {}", place, coordinates(box.low),
                                        coordinates(box.high)));
  return found;
}

}  // namespace

const std::vector<Index>& find_node_set(const Model& model, const std::string& place,
                                        const std::string& name) {
  const auto found = model.node_sets.find(name);
  if (found == model.node_sets.end())
    throw core::ConfigError(
        fmt::format("{}: there is no node set '{}'; known here: {}", place, name, known_names(model)));
  return found->second;
}

std::vector<Index> select_nodes(const Model& model, const NodeSelection& selection) {
  if (selection.nodes) return find_node_set(model, selection.place, *selection.nodes);
  if (selection.at) return {node_at(model, selection.place, *selection.at)};
  return nodes_in(model, selection.place, *selection.box);
}

}  // namespace talus::fem
