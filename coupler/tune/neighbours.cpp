#include "coupler/tune/neighbours.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "core/scene/reader.hpp"
#include "core/units/units.hpp"
#include "coupler/accuracy/scene_tree.hpp"

namespace talus::tune {
namespace {

using accuracy::node_at;
using core::SceneNode;
using Vector = std::array<double, 3>;

struct Moving {
  std::string path;  ///< "particles.spheres.boulder"
  Vector velocity{}, at{};
  double diameter = 0;  ///< m; 0: unknown
};

double number(const SceneNode* node, const char* unit) {
  return node ? core::parse_quantity(node->scalar, unit).value_or(0) : 0;
}

std::optional<Vector> vector_at(const SceneNode* node, const char* unit) {
  if (node == nullptr || node->items.size() != 3) return std::nullopt;
  Vector vector{};
  for (std::size_t i = 0; i < 3; ++i) vector[i] = number(&node->items[i], unit);
  return vector;
}

std::string text(const Vector& v, const char* unit) {
  return fmt::format("[{0:.17g} {3}, {1:.17g} {3}, {2:.17g} {3}]", v[0], v[1], v[2], unit);
}

double length(const Vector& v) {
  return std::hypot(v[0], v[1], v[2]);
}

/// A rock's filling does not tell its size before it is made; a block does.
double diameter_of(const SceneNode& body) {
  if (const auto* radius = node_at(body, "radius")) return 2 * number(radius, "m");
  return number(node_at(body, "block.edge"), "m");
}

std::vector<Moving> moving_bodies(const SceneNode& tree) {
  std::vector<Moving> all;
  for (const char* kind : {"particles.spheres", "particles.rocks"}) {
    const SceneNode* bodies = node_at(tree, kind);
    if (bodies == nullptr) continue;
    for (const auto& body : bodies->entries) {
      const auto velocity = vector_at(node_at(body.value, "velocity"), "m/s"),
                 at = vector_at(node_at(body.value, "at"), "m");
      if (velocity && at && length(*velocity) > 0)
        all.push_back({std::string(kind) + "." + body.key, *velocity, *at, diameter_of(body.value)});
    }
  }
  return all;
}

/// The axis most across the velocity.
Vector across(const Vector& velocity) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(velocity[i]) < std::abs(velocity[least])) least = i;
  Vector axis{};
  axis[least] = 1;
  return axis;
}

void add_speed(const std::vector<Moving>& bodies, double factor, std::vector<Neighbour>& all) {
  Neighbour one{fmt::format("{:.0f} % {}", 100 * perturbation, factor > 1 ? "faster" : "slower"), {}};
  for (const auto& body : bodies) {
    Vector velocity = body.velocity;
    for (double& v : velocity) v *= factor;
    one.settings.push_back({body.path + ".velocity", text(velocity, "m/s")});
  }
  all.push_back(one);
}

void add_place(const std::vector<Moving>& bodies, double factor, std::vector<Neighbour>& all) {
  Neighbour one{
      fmt::format("shifted by {}{:.0f} % of the diameter", factor > 0 ? "" : "-", 100 * perturbation), {}};
  for (const auto& body : bodies) {
    if (body.diameter <= 0) continue;
    Vector at = body.at;
    const Vector axis = across(body.velocity);
    for (std::size_t i = 0; i < 3; ++i) at[i] += factor * perturbation * body.diameter * axis[i];
    one.settings.push_back({body.path + ".at", text(at, "m")});
  }
  if (!one.settings.empty()) all.push_back(one);
}

void add_mass(const SceneNode& tree, const std::vector<Moving>& bodies, double factor,
              std::vector<Neighbour>& all) {
  Neighbour one{fmt::format("{:.0f} % {}", 100 * perturbation, factor > 1 ? "heavier" : "lighter"), {}};
  std::set<std::string> keys;
  for (const auto& body : bodies) {
    const SceneNode* material = node_at(tree, body.path + ".material");
    const std::string mass = body.path + ".block.mass";
    const std::string density = material ? "particles.materials." + material->scalar + ".density" : "";
    const bool by_mass = node_at(tree, mass) != nullptr;
    const std::string& key = by_mass ? mass : density;
    const SceneNode* value = node_at(tree, key);
    const char* unit = by_mass ? "kg" : "kg/m^3";
    if (!key.empty() && value != nullptr && keys.insert(key).second)
      one.settings.push_back({key, fmt::format("{:.17g} {}", factor * number(value, unit), unit)});
  }
  if (!one.settings.empty()) all.push_back(one);
}

}  // namespace

std::vector<Neighbour> neighbours_of(const core::SceneFile& scene) {
  const SceneNode tree = accuracy::effective_tree(scene);
  const auto bodies = moving_bodies(tree);
  std::vector<Neighbour> all;
  if (bodies.empty()) return all;
  for (const double sign : {1.0, -1.0}) {
    add_speed(bodies, 1 + sign * perturbation, all);
    add_mass(tree, bodies, 1 + sign * perturbation, all);
    add_place(bodies, sign, all);
  }
  return all;
}

}  // namespace talus::tune
