#include "coupler/accuracy/causes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/units/units.hpp"
#include "coupler/accuracy/clock.hpp"
#include "coupler/accuracy/scene_tree.hpp"

namespace talus::accuracy {
namespace {

using nlohmann::json;
using study::Setting;
using Settings = std::optional<std::vector<Setting>>;

const std::vector<double> twice{2, 4}, half{0.5, 0.25};
/// A mesh of twice the size may have lost the shape of the thing.
const std::vector<double> coarser_meshes{1.5, 2.25}, finer_meshes{1 / 1.5};

Settings settings_of(const std::optional<Clock>& clock) {
  return clock ? Settings(accuracy::settings_of(*clock)) : std::nullopt;
}

/// Central differences and the generalised-alpha method are of second order; forces that depend on velocities
/// or jump (dashpots and friction of contacts, bulk damping of elements, brakes, what breaks) are of first.
Orders orders_of_structure(const core::SceneNode& tree) {
  static const std::regex first_order(
      R"(^structure\..*\b(friction|stiffness|brake|breaks|elastic_plastic_cable|distance)\b.*)");
  Orders orders{2, 2};
  for_each_value(tree, [&](const std::string& path, const std::string&) {
    const bool spring = path.find("penalty") != std::string::npos;
    if (!spring && std::regex_match(path, first_order)) orders = {1, 2};
  });
  return orders;
}

/// The window with the steps that are tied to it.
Cause window_cause(const Clock& clock, const Orders& expected) {
  const auto tied = clock.tied();
  const bool only_step = !clock.coupled;
  std::string name = only_step ? "step" : "window";
  std::string changes = only_step ? "the step" : "the window; the steps of both sides stay";
  if (!tied.empty() && !only_step) {
    name = tied.size() > 1 ? "steps and window" : "window and step of the " + tied.front();
    changes = fmt::format("the window and the step of the {}, which takes one a window, together",
                          fmt::join(tied, " and that of the "));
  }
  return {.name = name,
          .changes = changes,
          .expected = expected,
          .coarser = twice,
          .finer = half,
          .settings = [clock](double size) { return settings_of(with_window(clock, size)); }};
}

Cause step_cause(const Clock& clock, const std::string& side, const Orders& expected) {
  return {.name = "step of the " + side,
          .changes = fmt::format("the step of the {}; the window stays", side),
          .expected = expected,
          .coarser = twice,
          .finer = half,
          .settings = [=](double size) { return settings_of(with_step(clock, side, size)); }};
}

void add_time_causes(const core::SceneNode& tree, const core::SceneFile& scene, const json& summary,
                     std::vector<Cause>& causes) {
  const Clock clock = clock_of(scene, summary);
  const Orders structure = orders_of_structure(tree), contacts{1, 2};
  const bool particles = scene.has_section("particles");
  const bool has_window = clock.coupled || !clock.tied().empty();
  const bool is_static = clock.sides.size() == 1 && clock.sides.front().fixed;
  if (has_window && !is_static) causes.push_back(window_cause(clock, particles ? contacts : structure));
  for (const auto& side : clock.sides)
    if (!clock.is_tied(side) && !side.fixed && !side.foreign)
      causes.push_back(
          step_cause(clock, side.name, side.name == "structure" && !particles ? structure : contacts));
}

/// Load steps matter to what remembers its path.
void add_load_steps(const core::SceneNode& tree, const json& summary, std::vector<Cause>& causes) {
  if (node_at(tree, "structure.static") == nullptr) return;
  const double step = summary.at("step_s").at("structure"), end = summary.at("simulated_time_s");
  causes.push_back({.name = "load steps",
                    .changes = "the number of load steps",
                    .expected = {1, 2},
                    .coarser = {},
                    .finer = half,
                    .settings = [steps = end / step](double size) {
                      return Settings({{"structure.static.steps", fmt::format("{:.0f}", steps / size)}});
                    }});
}

/// Sizes of meshes and fillings that the scene names: each a cause, with the spacing on its outline.
void add_meshes(const core::SceneNode& tree, std::vector<Cause>& causes) {
  static const std::regex mesh(R"((.*\.)?([^.]+)(\.[^.]+)\.(element_size|deviation|spacing))");
  for_each_value(tree, [&](const std::string& path, const std::string& value) {
    std::smatch found;
    const auto size = core::parse_quantity(value, "m");
    if (!size || !std::regex_match(path, found, mesh)) return;
    const bool filling = found[4] != "element_size";
    const std::string name = (filling ? "spheres of " : "mesh of ") + found[2].str();
    const std::string outline = path.substr(0, path.rfind('.')) + ".edge_spacing";
    const core::SceneNode* edge = node_at(tree, outline);
    const auto spacing = edge ? core::parse_quantity(edge->scalar, "m") : std::nullopt;
    causes.push_back({.name = name,
                      .changes = path,
                      .expected = {1, 2},
                      .coarser = coarser_meshes,
                      .finer = finer_meshes,
                      .settings = [=](double factor) {
                        std::vector<Setting> settings{{path, fmt::format("{:.17g} m", *size * factor)}};
                        if (spacing)
                          settings.push_back({outline, fmt::format("{:.17g} m", *spacing * factor)});
                        return Settings(settings);
                      }});
  });
}

/// A tolerance ten times as wide.
void add_tolerance(const core::SceneNode& tree, const json& summary, std::vector<Cause>& causes) {
  if (!summary.contains("iterations")) return;
  constexpr double default_tolerance = 1e-6;
  const std::string key = "coupling." + summary.at("scheme").get<std::string>() + ".tolerance.relative";
  const core::SceneNode* written = node_at(tree, key);
  const double tolerance =
      written ? core::parse_quantity(written->scalar, "").value_or(default_tolerance) : default_tolerance;
  causes.push_back({.name = "iterations",
                    .changes = key,
                    .expected = {1, 1},
                    .coarser = {10},
                    .finer = {},
                    .settings = [=](double factor) {
                      return Settings({{key, fmt::format("{:.17g}", tolerance * factor)}});
                    }});
}

}  // namespace

std::vector<Cause> causes_of(const core::SceneFile& scene, const json& summary) {
  const core::SceneNode tree = effective_tree(scene);
  std::vector<Cause> causes;
  add_time_causes(tree, scene, summary, causes);
  add_load_steps(tree, summary, causes);
  add_meshes(tree, causes);
  add_tolerance(tree, summary, causes);
  return causes;
}

}  // namespace talus::accuracy
