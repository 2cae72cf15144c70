#pragma once

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "fem_solver/model/model.hpp"

/// The key `slides`: nodes that run along ropes made of other elements.
namespace talus::fem {

/// Springs hold the nodes on the rope.
struct PenaltySlideScene {
  double stiffness = 0;  ///< N/m
};
void describe(core::Fields& fields, PenaltySlideScene& penalty);

/// Multi-point constraints hold them.
struct ConstraintSlideScene {};
void describe(core::Fields& fields, ConstraintSlideScene& constraint);

struct SlideScene {
  std::string place;
  std::string rope;   ///< a part
  std::string nodes;  ///< a node set
  std::variant<PenaltySlideScene, ConstraintSlideScene> method;
};
void describe(core::Fields& fields, SlideScene& slide);

using NamedSlide = std::pair<std::string, SlideScene>;

/// Before elements are made: nodes that constraints are to lead start on their rope, so that no step has to take them
/// there. @param rope segments of the rope's part, by node
/// @throws core::ConfigError where they are no line
void put_on_rope(const NamedSlide& slide, const std::vector<std::array<Index, 2>>& rope, Model& model);

/// Adds a slide to the model: springs as a part, constraints beside the parts.
/// @pre parts, their elements and node sets are there
/// @throws core::ConfigError where the rope is no line of two-node elements, or a slider is a node of it or
/// far from it
void add_slide(const NamedSlide& slide, Model& model);

}  // namespace talus::fem
