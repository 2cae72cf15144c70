#include "fem_solver/scene/slides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "core/scene/plausible.hpp"
#include "core/units/units.hpp"
#include "fem_solver/constraints/nearest_segment.hpp"
#include "fem_solver/model/rope_batch.hpp"
#include "fem_solver/scene/node_sets.hpp"

namespace talus::fem {
namespace {

/// How far a slider may be from its rope at the start, of the rope's length: farther is a slip of the pen.
constexpr double farthest_share = 0.01;

std::string key(const NamedSlide& slide) {
  return fmt::format("{}: structure.slides.{}", slide.second.place, slide.first);
}

/// The nodes of a rope along it.
std::vector<Index> rope_nodes(const NamedSlide& slide, const std::vector<std::array<Index, 2>>& segments,
                              const Model& model) {
  try {
    return RopeLine(segments, model.reference).nodes();
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(fmt::format("{}.rope: {}", key(slide), error.what()));
  }
}

std::vector<Index> rope_nodes(const NamedSlide& slide, const Model& model) {
  const auto part = std::ranges::find(model.parts, slide.second.rope, &Part::name);
  if (part == model.parts.end())
    throw core::ConfigError(
        fmt::format("{}.rope: the structure has no part '{}'", key(slide), slide.second.rope));
  return std::visit(
      [&](const auto& batch) -> std::vector<Index> {
        if constexpr (std::tuple_size_v<std::decay_t<decltype(batch.cells().front())>> == 2)
          return rope_nodes(slide, batch.cells(), model);
        else
          throw core::ConfigError(
              fmt::format("{}.rope: '{}' is not made of lines", key(slide), slide.second.rope));
      },
      part->elements);
}

double length_of(const std::vector<Index>& rope, const Model& model) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < rope.size(); ++k)
    length += (model.position(rope[k + 1]) - model.position(rope[k])).norm();
  return length;
}

/// The point of a rope that is nearest to a node, and how far that is (m).
struct PlaceOnRope {
  Vector3 point;
  double gap = 0;
};
PlaceOnRope place_on_rope(const std::vector<Index>& rope, Index node, const Model& model) {
  const auto position = [&](std::size_t k) { return model.position(rope[k]); };
  const NearestSegment nearest = nearest_segment(rope.size() - 1, position, model.position(node));
  const Vector3 first = position(nearest.segment), second = position(nearest.segment + 1);
  return {first + nearest.fraction * (second - first), std::sqrt(nearest.squared_distance)};
}

/// @return m; the largest gap
double check_sliders(const NamedSlide& slide, const SlideLine& line, const Model& model) {
  const double farthest = farthest_share * length_of(line.rope, model);
  double largest = 0;
  for (const Index node : line.sliders) {
    if (std::ranges::find(line.rope, node) != line.rope.end())
      throw core::ConfigError(
          fmt::format("{}.nodes: {} is a node of the rope itself", key(slide), node_name(model, node)));
    const double gap = place_on_rope(line.rope, node, model).gap;
    if (gap > farthest)
      throw core::ConfigError(fmt::format("{}.nodes: {} is {:.4g} m away from the rope, more than {:.4g} m",
                                          key(slide), node_name(model, node), gap, farthest));
    largest = std::max(largest, gap);
  }
  return largest;
}

std::vector<Index> ascending(std::vector<Index> nodes) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void describe(core::Fields& fields, PenaltySlideScene& penalty) {
  fields.required("stiffness", penalty.stiffness,
                  {.unit = "N/m",
                   .range = core::positive,
                   .help = "of the spring of each node; leaves a gap of force over stiffness",
                   .plausible = core::plausible::stiffness});
}
void describe(core::Fields&, ConstraintSlideScene&) {}

void describe(core::Fields& fields, SlideScene& slide) {
  slide.place = fields.place();
  fields.required("rope", slide.rope, {.help = "the part of two-node elements they run along"});
  fields.required("nodes", slide.nodes, {.help = "the node set that runs: net.edge_south"});
  fields.one_of(slide.method, {{"penalty", "springs hold the nodes on the rope, with a gap"},
                               {"constraint", "constraints hold them, without"}});
}

void put_on_rope(const NamedSlide& slide, const std::vector<std::array<Index, 2>>& rope, Model& model) {
  if (!std::holds_alternative<ConstraintSlideScene>(slide.second.method) || rope.empty()) return;
  const std::vector<Index> line = rope_nodes(slide, rope, model);
  const double farthest = farthest_share * length_of(line, model);
  double moved = 0;
  for (const Index node : find_node_set(model, key(slide) + ".nodes", slide.second.nodes)) {
    if (std::ranges::find(line, node) != line.end()) continue;  // which add_slide() refuses
    const PlaceOnRope place = place_on_rope(line, node, model);
    if (place.gap == 0 || place.gap > farthest) continue;
    std::ranges::copy(place.point, &model.reference[3 * static_cast<std::size_t>(node)]);
    moved = std::max(moved, place.gap);
  }
  if (moved > 0)
    core::log_info(fmt::format("{}: its nodes were put on the rope, up to {} away", key(slide),
                               core::readable(moved, "m")));
}

void add_slide(const NamedSlide& slide, Model& model) {
  const auto& [name, scene] = slide;
  if (std::ranges::find(model.parts, name, &Part::name) != model.parts.end())
    throw core::ConfigError(fmt::format("{}: there is a part of this name already", key(slide)));
  SlideLine line{rope_nodes(slide, model), find_node_set(model, key(slide) + ".nodes", scene.nodes)};
  const double gap = check_sliders(slide, line, model);
  const auto* penalty = std::get_if<PenaltySlideScene>(&scene.method);
  if (!penalty) {
    constexpr double round_off = 1e-9;  // of the rope's length
    if (gap > round_off * length_of(line.rope, model))
      throw core::ConfigError(fmt::format(
          "{}.nodes: a node was put on another rope, {:.4g} m away from this one: two slides lead it",
          key(slide), gap));
    return model.constrained_slides.push_back({name, std::move(line)});
  }
  std::vector<Index> nodes = line.rope;
  nodes.insert(nodes.end(), line.sliders.begin(), line.sliders.end());
  model.parts.push_back({name, PenaltySlideBatch(std::move(line), penalty->stiffness, model.reference),
                         ascending(std::move(nodes))});
}

}  // namespace talus::fem
