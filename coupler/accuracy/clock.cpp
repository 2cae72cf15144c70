#include "coupler/accuracy/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scene/reader.hpp"
#include "core/scene/tree.hpp"
#include "core/units/units.hpp"
#include "coupler/accuracy/scene_tree.hpp"

namespace talus::accuracy {
namespace {

using nlohmann::json;

constexpr double near_one = 1e-6;

bool is_whole(double ratio) {
  return std::abs(ratio - std::round(ratio)) <= near_one * ratio && ratio > 0.5;
}

/// The largest step that keeps every limit; 0 where one is exceeded already. Those of stability move with the
/// step where mass is scaled for it.
double largest_step(const json& summary, const SideClock& side, Limits limits) {
  double largest = HUGE_VAL;
  for (const auto& limit : summary.value("limits", json::array())) {
    const bool stability = limit.at("kind") == "stability";
    if (limit.at("side") != side.name || (limits == Limits::stability && !stability)) continue;
    if (limit.value("exceeded", false)) return 0;
    if (side.mass_step > 0 && stability) continue;
    largest = std::min(largest, limit.at("limit_s").get<double>());
  }
  return largest;
}

std::optional<SideClock> scaled(SideClock side, double factor) {
  if (side.fixed || (factor > 1 && side.step * factor > side.largest)) return std::nullopt;
  side.step *= factor;
  side.mass_step *= factor;
  return side;
}

double seconds_at(const core::SceneNode& tree, const std::string& key) {
  const core::SceneNode* node = node_at(tree, key);
  return node ? core::parse_quantity(node->scalar, "s").value_or(0) : 0;
}

}  // namespace

bool Clock::is_tied(const SideClock& side) const {
  return std::abs(side.step - window) <= near_one * window;
}

std::vector<std::string> Clock::tied() const {
  std::vector<std::string> names;
  for (const auto& side : sides)
    if (is_tied(side)) names.push_back(side.name);
  return names;
}

Clock clock_of(const core::SceneFile& scene, const json& summary, Limits limits) {
  const core::SceneNode tree = effective_tree(scene);
  Clock clock{.window = summary.at("window_s"),
              .sides = {},
              .coupled = scene.has_section("interface"),
              .names_window = node_at(tree, "coupling.window") != nullptr};
  for (const auto& [name, step] : summary.at("step_s").items()) {
    SideClock side{.name = name,
                   .step = step,
                   .mass_step = seconds_at(tree, name + ".mass_scaling.step"),
                   .named = node_at(tree, name + ".step") != nullptr,
                   .foreign = node_at(tree, name + ".solver") != nullptr,
                   .fixed = node_at(tree, name + ".static") != nullptr};
    side.largest = largest_step(summary, side, limits);
    clock.sides.push_back(side);
  }
  return clock;
}

std::optional<Clock> with_step(const Clock& clock, const std::string& side, double factor) {
  Clock changed = clock;
  for (auto& own : changed.sides) {
    if (own.name != side) continue;
    const auto other = scaled(own, factor);
    if (!other || own.foreign) return std::nullopt;
    own = *other;
    if (!is_whole(changed.window / own.step)) return std::nullopt;
  }
  return changed;
}

std::optional<Clock> with_window(const Clock& clock, double factor) {
  Clock changed = clock;
  changed.window *= factor;
  for (auto& side : changed.sides) {
    if (clock.is_tied(side)) {
      const auto other = scaled(side, factor);
      if (!other) return std::nullopt;
      side = *other;
    } else if (!is_whole(changed.window / side.step)) {
      return std::nullopt;
    }
  }
  return changed;
}

std::optional<Clock> with_all(const Clock& clock, double factor) {
  Clock changed = clock;
  changed.window *= factor;
  for (auto& side : changed.sides) {
    const auto other = scaled(side, factor);
    if (!other || (side.foreign && !clock.is_tied(side))) return std::nullopt;
    side = *other;
  }
  return changed;
}

std::vector<study::Setting> settings_of(const Clock& clock) {
  if (clock.sides.empty()) return {};
  const auto text = [](double seconds) { return fmt::format("{:.17g} s", seconds); };
  std::vector<study::Setting> settings;
  const bool tied = !clock.tied().empty();
  if (tied) settings.push_back({"time.step", text(clock.window)});
  if (!tied || clock.names_window) settings.push_back({"coupling.window", text(clock.window)});
  for (const auto& side : clock.sides) {
    if (side.fixed || side.foreign) continue;
    if (!clock.is_tied(side)) settings.push_back({side.name + ".step", text(side.step)});
    if (clock.is_tied(side) && side.named) settings.push_back({side.name + ".step", "~"});
    if (side.mass_step > 0) settings.push_back({side.name + ".mass_scaling.step", text(side.mass_step)});
  }
  return settings;
}

}  // namespace talus::accuracy
