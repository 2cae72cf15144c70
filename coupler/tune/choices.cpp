#include "coupler/tune/choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/scene/reader.hpp"
#include "core/scene/tree.hpp"
#include "core/units/units.hpp"
#include "coupler/accuracy/scene_tree.hpp"
#include "coupler/explain/facts.hpp"
#include "coupler/explain/rules.hpp"

namespace talus::tune {
namespace {

using accuracy::node_at;

constexpr double coarser_mesh = 1.5;
const char* const contact_reason =
    "contacts with light nodes act with the velocity at the step's end: no dashpot limits the step";

Change contact_change(const core::SceneNode& tree) {
  const bool implicit = node_at(tree, "particles.implicit_contact") != nullptr;
  return {.group = "contact",
          .name = implicit ? "explicit contact" : "implicit contact",
          .settings = {{"particles.implicit_contact", implicit ? "~" : "{}"}},
          .reason = implicit ? "contacts act with the velocity of half a step ago: a step costs less"
                             : contact_reason};
}

Change scheme_change(const std::string& name, const std::string& key, const std::string& value,
                     const std::string& reason) {
  return {.group = "scheme", .name = name, .settings = {{"coupling." + key, value}}, .reason = reason};
}

/// Every scheme but the scene's own.
void add_schemes(const core::SceneNode& tree, std::vector<Change>& changes) {
  const bool strong = node_at(tree, "coupling.serial_implicit") != nullptr ||
                      node_at(tree, "coupling.parallel_implicit") != nullptr;
  const std::string iterated = "both sides are iterated until they agree: long windows keep their order";
  changes.push_back(scheme_change("IQN-ILS", "serial_implicit", "{iqn_ils: {}}", iterated));
  changes.push_back(scheme_change("IQN-ILS on the free motion", "serial_implicit",
                                  "{relax: free_motion, iqn_ils: {}}", iterated));
  changes.push_back(scheme_change("Aitken", "serial_implicit", "{aitken: {}}", iterated));
  if (strong)
    changes.push_back(
        scheme_change("weak coupling", "serial_explicit", "{}", "each side is called once a window"));
}

/// The list at `path` without `key` in its entry: "particles.contacts", 0, "friction".
std::optional<study::Setting> without_entry(const core::SceneNode& tree, const std::string& key) {
  static const std::regex form(R"(([^\[]+)\[(\d+)\]\.([^.\[]+))");
  std::smatch found;
  if (!std::regex_match(key, found, form)) return std::nullopt;
  const core::SceneNode* list = node_at(tree, found[1]);
  const auto index = static_cast<std::size_t>(std::stoul(found[2]));
  if (list == nullptr || index >= list->items.size()) return std::nullopt;
  core::SceneNode changed = *list;
  std::erase_if(changed.items[index].entries,
                [&](const core::SceneEntry& entry) { return entry.key == found[3].str(); });
  return study::Setting{found[1], core::canonical_text(changed)};
}

std::optional<study::Setting> leaving_out(const core::SceneNode& tree, const std::string& key) {
  if (node_at(tree, key) == nullptr) return std::nullopt;
  if (key.find('[') == std::string::npos) return study::Setting{key, "~"};
  return without_entry(tree, key);
}

void add_slides(const core::SceneNode& tree, std::vector<Change>& changes) {
  const core::SceneNode* slides = node_at(tree, "structure.slides");
  if (slides == nullptr) return;
  for (const auto& slide : slides->entries) {
    if (slide.value.find("penalty") == nullptr) continue;
    changes.push_back({.group = "slide " + slide.key,
                       .name = slide.key + " by constraints",
                       .settings = {{"structure.slides." + slide.key + ".constraint", "{}"}},
                       .reason = "no spring limits the step"});
  }
}

void add_wrinkles(const core::SceneNode& tree, std::vector<Change>& changes) {
  const core::SceneNode* parts = node_at(tree, "structure.parts");
  if (parts == nullptr) return;
  for (const auto& part : parts->entries) {
    const core::SceneNode* direction = node_at(part.value, "membrane.tension_field.wrinkle_direction");
    if (node_at(part.value, "membrane.tension_field") == nullptr) continue;
    const bool iterated = direction == nullptr || direction->scalar == "iterated";
    const std::string other = iterated ? "principal" : "iterated";
    changes.push_back(
        {.group = "wrinkles of " + part.key,
         .name = other + " wrinkles of " + part.key,
         .settings = {{"structure.parts." + part.key + ".membrane.tension_field.wrinkle_direction", other}},
         .reason = "another way to the same wrinkles"});
  }
}

void add_meshes(const core::SceneNode& tree, std::vector<Change>& changes) {
  static const std::regex mesh(
      R"((structure\.parts|particles\.rocks)\.([^.]+)\.[^.]+\.(element_size|deviation|spacing))");
  accuracy::for_each_value(tree, [&](const std::string& path, const std::string& value) {
    std::smatch found;
    const auto size = core::parse_quantity(value, "m");
    if (!size || !std::regex_match(path, found, mesh)) return;
    const std::string what = found[3] == "element_size" ? "mesh" : "spheres";
    changes.push_back(
        {.group = path,
         .name = fmt::format("{} of {} {}", what, found[2].str(), core::readable(coarser_mesh * *size, "m")),
         .settings = {{path, fmt::format("{:.6g} m", coarser_mesh * *size)}},
         .reason = fmt::format("in place of {}", value)});
  });
}

}  // namespace

std::vector<Change> other_methods(const core::SceneFile& scene) {
  const core::SceneNode tree = accuracy::effective_tree(scene);
  std::vector<Change> changes;
  if (scene.has_section("interface")) {
    if (node_at(tree, "particles.solver") == nullptr) changes.push_back(contact_change(tree));
    add_schemes(tree, changes);
    return changes;
  }
  if (!scene.has_section("structure") || node_at(tree, "structure.static") != nullptr) return changes;
  const bool implicit = node_at(tree, "structure.implicit") != nullptr;
  changes.push_back({.group = "method",
                     .name = implicit ? "explicit structure" : "implicit structure",
                     .settings = {{implicit ? "structure.explicit" : "structure.implicit", "{}"}},
                     .reason = implicit ? "a step costs one evaluation of forces"
                                        : "no limit of stability binds the step"});
  return changes;
}

std::vector<Change> other_models(const core::SceneFile& scene) {
  const core::SceneNode tree = accuracy::effective_tree(scene);
  std::vector<Change> changes;
  add_slides(tree, changes);
  add_wrinkles(tree, changes);
  add_meshes(tree, changes);
  return changes;
}

std::optional<Candidate> with_scaled_mass(const core::SceneFile& scene, const Candidate& candidate) {
  const core::SceneNode tree = accuracy::effective_tree(scene);
  for (const char* method : {"structure.implicit", "structure.static"})
    if (node_at(tree, method) != nullptr) return std::nullopt;
  if (candidate.change_in("method") != nullptr) return std::nullopt;
  Candidate scaled = candidate;
  for (auto& side : scaled.clock.sides) {
    if (side.name != "structure" || side.foreign || side.mass_step > 0) continue;
    side.mass_step = side.step;
    side.largest = HUGE_VAL;  // the mass sees to it
    const auto longer = candidate.clock.is_tied(side) ? accuracy::with_window(scaled.clock, 2)
                                                      : accuracy::with_step(scaled.clock, side.name, 2);
    if (!longer) return std::nullopt;
    scaled.clock = *longer;
    return scaled;
  }
  return std::nullopt;
}

std::vector<Change> effects_that_may_go(const core::SceneFile& scene, const std::filesystem::path& result) {
  const core::SceneNode tree = accuracy::effective_tree(scene);
  const auto facts = explain::read_facts(result);
  std::vector<Change> changes;
  for (const auto& finding : explain::findings_of(facts)) {
    if (finding.kind != explain::Finding::Kind::may_be_left_out || finding.key.empty()) continue;
    const auto setting = leaving_out(tree, finding.key);
    if (!setting) continue;
    changes.push_back({.group = "without " + finding.key,
                       .name = "without " + finding.key,
                       .settings = {*setting},
                       .reason = finding.text,
                       .drops_an_effect = true});
  }
  return changes;
}

}  // namespace talus::tune
