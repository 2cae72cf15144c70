#pragma once

#include <string>
#include <vector>

#include "core/vector3.hpp"
#include "coupler/barrier/sheet.hpp"

/// Where everything of a barrier stands, in the frame of the slope: x along the row from the first post, y up the slope, z off
/// it; the ground is z = 0.
namespace talus::barrier {

inline constexpr double standard_gravity = 9.81;  ///< m/s^2

/// Of a block's edge: how far its surface is from its centre at most, sqrt(6)/4.
inline constexpr double reach_of_block = 0.6124;

struct Layout {
  std::vector<core::Vector3> feet, heads;  ///< m; of the posts
  std::vector<core::Vector3>
      retaining_anchors;  ///< m; one more than posts, between them and beyond the last ones
  /// To the west (x < 0) and the east: of the lateral ropes and of the support ropes above and below.
  core::Vector3 lateral_anchor[2], upper_anchor[2], lower_anchor[2];
  core::Vector3 upper_end[2],
      lower_end[2];  ///< m; where the support ropes begin: at the ends of the brakes, or of pieces of rope
  core::Vector3 up_the_post;              ///< unit vector from foot to head
  core::Vector3 net_corner;               ///< m; below the first post's head
  double net_length = 0, net_height = 0;  ///< m
  core::Vector3 net_normal;               ///< unit vector up the slope, towards the block
  core::Vector3 hit;                      ///< m; on the net
  double block_edge = 0;                  ///< m; of the cube it is cut from
  core::Vector3 block_centre;             ///< m
  double retaining_angle = 0;  ///< rad; tau, between post and retaining ropes in the plane across the row
};
Layout layout_of(const BarrierSheet& sheet);

/// What an engineer would object to, a sentence each: errors (the barrier cannot stand so) and warnings.
struct Findings {
  std::vector<std::string> errors, warnings;
};
Findings findings_of(const BarrierSheet& sheet, const Layout& layout);

}  // namespace talus::barrier
