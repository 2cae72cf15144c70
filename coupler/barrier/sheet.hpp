#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/fields.hpp"

/// A barrier's data sheet as it is written: `title:` and `barrier:` in a file of its own (docs/barriers.md). Words and
/// defaults are those of the trade; what a default rests on is told where the scene is written (scene_text.hpp).
namespace talus::barrier {

/// Posts hinged at their feet, in a row along x.
struct PostSheet {
  std::int64_t count = 4;
  double spacing = 10;       ///< m
  double length = 0;         ///< m
  double lean = 0.2617994;   ///< rad; back up the slope, from its normal
  double foot_height = 0.5;  ///< m; above the ground
  std::string profile;
};
void describe(core::Fields& fields, PostSheet& posts);

/// A net of rhombic meshes, computed as a membrane and met by the block wire by wire; or of rings, each an element.
struct NetSheet {
  std::string kind;
  double gap = 0.05;            ///< m; between its edges and the posts' ends
  double cell_along = 1.0 / 3;  ///< m; of the membrane's mesh
  double cell_across = 0.55;    ///< m
};
void describe(core::Fields& fields, NetSheet& net);

struct BrakeSheet {
  double force = 0;   ///< N; of one
  double travel = 0;  ///< m
  double length = 1;  ///< m; of the device, beside its anchor
};
void describe(core::Fields& fields, BrakeSheet& brakes);

/// Upper and lower ropes through all heads and feet.
struct SupportRopeSheet {
  double diameter = 0;      ///< m
  std::int64_t number = 1;  ///< side by side, each with its brakes
  std::optional<double> friction;
  std::optional<BrakeSheet> brakes;  ///< at both ends of each
};
void describe(core::Fields& fields, SupportRopeSheet& ropes);

struct RetainingRopeSheet {
  double diameter = 0;  ///< m
  double upslope = 0;   ///< m; from the posts' feet to the anchors, along the slope
};
void describe(core::Fields& fields, RetainingRopeSheet& ropes);

struct LateralRopeSheet {
  double diameter = 0;  ///< m
  double beside = 5;    ///< m; from the edge posts to the anchors, along the row
};
void describe(core::Fields& fields, LateralRopeSheet& ropes);

/// The block of the type test and where it hits.
struct BlockSheet {
  enum class Form { eota_111, eota_221 } form = Form::eota_111;
  double mass = 0;                             ///< kg
  double density = 2700;                       ///< kg/m^3
  double speed = 25;                           ///< m/s; down the slope
  double distance = 0.02;                      ///< m; in front of the net at the start
  core::Vector3 spin = core::Vector3::Zero();  ///< rad/s
  std::optional<double> along;                 ///< m; of the hit, from the first post; absent: the middle
  std::optional<double>
      height;  ///< m; of the hit along the posts, from their feet; absent: the middle of the net
};
void describe(core::Fields& fields, BlockSheet& block);

/// The slope itself, in which posts and anchors stand.
struct GroundSheet {
  double friction = 0.5;
};
void describe(core::Fields& fields, GroundSheet& ground);

struct TestSheet {
  enum class Start { flat, hung } start = Start::flat;
  enum class Breaks { nothing, at_breaking_load } breaks = Breaks::nothing;
  double time = 0.7;           ///< s
  std::optional<double> step;  ///< s
};
void describe(core::Fields& fields, TestSheet& test);

struct BarrierSheet {
  double slope = 1.5707963;  ///< rad
  PostSheet posts;
  NetSheet net;
  SupportRopeSheet support_ropes;
  RetainingRopeSheet retaining_ropes;
  LateralRopeSheet lateral_ropes;
  BlockSheet block;
  std::optional<GroundSheet> ground;
  TestSheet test;
};
void describe(core::Fields& fields, BarrierSheet& barrier);

struct LoadedSheet {
  std::string title;
  BarrierSheet sheet;
};
/// @throws ConfigError with all complaints
LoadedSheet load_sheet(const std::filesystem::path& path);

/// The keys as Markdown.
std::string sheet_schema();

}  // namespace talus::barrier
