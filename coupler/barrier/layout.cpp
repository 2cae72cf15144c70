#include "coupler/barrier/layout.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "coupler/barrier/components.hpp"

namespace talus::barrier {

namespace {

using core::Vector3;

constexpr double degree = std::numbers::pi / 180;
constexpr double end_piece = 1;  // m; of rope between an anchor and the first slider where there is no brake
/// m; down the slope from the row's line to the anchors of upper support and lateral ropes, that they do not meet in one point.
constexpr double upper_anchor_below = 0.4, lateral_anchor_below = 0.8;

double edge_of_block(const BlockSheet& block) {
  const double volume = block.mass / block.density * (block.form == BlockSheet::Form::eota_221 ? 2 : 1);
  return std::cbrt(volume * 24 / 17);
}

/// Half of the block's depth along its way, with a face parallel to the net.
double half_depth(const BlockSheet& block, double edge) {
  return block.form == BlockSheet::Form::eota_221 ? 0.25 * edge : 0.5 * edge;
}

/// What fits between the posts' ends: whole rings, or whole cells of the membrane, whose edges run along wires.
double height_of_net(const BarrierSheet& sheet) {
  const double room = sheet.posts.length - 2 * sheet.net.gap;
  const auto rings = find_ring_net(sheet.net.kind);
  const double piece = rings ? rings->diameter : sheet.net.cell_across;
  return std::floor(room / piece + 1e-9) * piece;
}

}  // namespace

Layout layout_of(const BarrierSheet& sheet) {
  const PostSheet& posts = sheet.posts;
  Layout layout;
  layout.up_the_post = {0, std::sin(posts.lean), std::cos(posts.lean)};
  for (std::int64_t k = 0; k < posts.count; ++k) {
    layout.feet.push_back({static_cast<double>(k) * posts.spacing, 0, posts.foot_height});
    layout.heads.push_back(layout.feet.back() + posts.length * layout.up_the_post);
  }
  for (std::int64_t k = 0; k <= posts.count; ++k)
    layout.retaining_anchors.push_back(
        {(static_cast<double>(k) - 0.5) * posts.spacing, sheet.retaining_ropes.upslope, 0});
  const double row = static_cast<double>(posts.count - 1) * posts.spacing;
  for (const int side : {0, 1}) {
    const double x = side == 0 ? -sheet.lateral_ropes.beside : row + sheet.lateral_ropes.beside;
    const std::size_t post = side == 0 ? 0 : layout.feet.size() - 1;
    layout.lateral_anchor[side] = {x, -lateral_anchor_below, 0};
    layout.upper_anchor[side] = {x, -upper_anchor_below, 0};
    layout.lower_anchor[side] = {x, 0, 0};
    const double length = sheet.support_ropes.brakes ? sheet.support_ropes.brakes->length : end_piece;
    const auto towards = [length](const Vector3& from, const Vector3& to) -> Vector3 {
      return from + length * (to - from).normalized();
    };
    layout.upper_end[side] = towards(layout.upper_anchor[side], layout.heads[post]);
    layout.lower_end[side] = towards(layout.lower_anchor[side], layout.feet[post]);
  }
  layout.net_length = row;
  layout.net_height = height_of_net(sheet);
  layout.net_corner = layout.feet[0] + 0.5 * (posts.length - layout.net_height) * layout.up_the_post;
  layout.net_normal = {0, std::cos(posts.lean), -std::sin(posts.lean)};
  const double along = sheet.block.along.value_or(0.5 * row);
  const double height = sheet.block.height.value_or(0.5 * posts.length);
  layout.hit = Vector3(along, 0, posts.foot_height) + height * layout.up_the_post;
  layout.block_edge = edge_of_block(sheet.block);
  layout.block_centre =
      layout.hit + (half_depth(sheet.block, layout.block_edge) + sheet.block.distance) * layout.net_normal;
  const double behind = sheet.retaining_ropes.upslope - posts.length * std::sin(posts.lean);
  layout.retaining_angle =
      posts.lean + std::atan2(behind, posts.length * std::cos(posts.lean) + posts.foot_height);
  return layout;
}

namespace {

class Inspection {
 public:
  Inspection(const BarrierSheet& sheet, const Layout& layout) : sheet_(sheet), layout_(layout) {}

  Findings run() {
    look_at_posts();
    look_at_ropes();
    look_at_net_and_block();
    look_at_energy();
    return findings_;
  }

 private:
  void unusual(bool is, std::string sentence) {
    if (is) findings_.warnings.push_back(std::move(sentence));
  }
  void impossible(bool is, std::string sentence) {
    if (is) findings_.errors.push_back(std::move(sentence));
  }

  void look_at_posts() {
    const PostSheet& posts = sheet_.posts;
    const double row = layout_.net_length;
    unusual(posts.spacing < 5 || posts.spacing > 12,
            fmt::format("posts.spacing is {:.3g} m; barriers are built with 5 to 12 m", posts.spacing));
    unusual(
        row > 60,
        fmt::format("the row is {:.3g} m long; after 60 m ropes are parted by an anchor in between", row));
    unusual(posts.lean > 20 * degree,
            fmt::format("posts.lean is {:.3g} deg; 10 to 15 deg is usual", posts.lean / degree));
    unusual(posts.foot_height < 0.1 || posts.foot_height > 0.8,
            fmt::format("posts.foot_height is {:.3g} m; 0.2 to 0.5 m is usual", posts.foot_height));
    unusual(posts.length > 0.8 * posts.spacing,
            fmt::format("posts of {:.3g} m stand {:.3g} m apart; less than 0.8 of the spacing is usual",
                        posts.length, posts.spacing));
  }

  void look_at_ropes() {
    const PostSheet& posts = sheet_.posts;
    const double upslope = sheet_.retaining_ropes.upslope, head = posts.length * std::sin(posts.lean);
    impossible(upslope <= head, fmt::format("the retaining ropes pull the posts over: their anchors ({:.3g} "
                                            "m up the slope) are not above the "
                                            "posts' heads ({:.3g} m); give retaining_ropes.upslope more",
                                            upslope, head));
    const double tau = layout_.retaining_angle / degree;
    unusual(upslope > head && (tau < 60 || tau > 85),
            fmt::format("the angle between post and retaining ropes is {:.3g} deg; 60 to 85 deg is usual: "
                        "retaining_ropes.upslope of {:.3g} m gives 65",
                        tau,
                        head + std::tan(65 * degree - posts.lean) *
                                   (posts.length * std::cos(posts.lean) + posts.foot_height)));
    unusual(sheet_.lateral_ropes.beside < 2 || sheet_.lateral_ropes.beside > 8,
            fmt::format("lateral_ropes.beside is {:.3g} m; 2 to 8 m is usual", sheet_.lateral_ropes.beside));
    if (const auto& brakes = sheet_.support_ropes.brakes) {
      const double way = (layout_.lower_anchor[0] - layout_.feet[0]).norm();
      impossible(
          brakes->length >= way,
          fmt::format(
              "the brakes ({:.3g} m) are longer than the way from their anchor to the post's foot ({:.3g} m)",
              brakes->length, way));
      const Rope& rope = *find_rope(sheet_.support_ropes.diameter);
      unusual(1.1 * brakes->force > 0.7 * rope.breaking_load,
              fmt::format("the brakes hold up to {:.3g} kN, more than 70 % of the breaking load of a support "
                          "rope ({:.3g} kN)",
                          1.1e-3 * brakes->force, 1e-3 * rope.breaking_load));
    }
  }

  void look_at_net_and_block() {
    const double edge = layout_.block_edge, row = layout_.net_length, along = layout_.hit.x();
    const double height = sheet_.block.height.value_or(0.5 * sheet_.posts.length);
    impossible(layout_.net_height <= 0, "net.gap leaves nothing of the net between the posts' ends");
    if (const auto rings = find_ring_net(sheet_.net.kind)) {
      const double along_row = row / rings->diameter, whole = std::round(along_row);
      impossible(
          std::abs(along_row - whole) > 0.01 * along_row,
          fmt::format(
              "the row of {:.4g} m is {:.4g} rings of {:.4g} m long; rings are whole: posts.spacing of "
              "{:.4g} m fits",
              row, along_row, rings->diameter,
              whole * rings->diameter / static_cast<double>(sheet_.posts.count - 1)));
    }
    impossible(edge > layout_.net_height,
               fmt::format("the block ({:.3g} m) is larger than the net is high ({:.3g} m)", edge,
                           layout_.net_height));
    impossible(along < 0 || along > row,
               fmt::format("block.along is {:.3g} m; the row goes from 0 to {:.3g} m", along, row));
    impossible(
        height < 0 || height > sheet_.posts.length,
        fmt::format("block.height is {:.3g} m; the posts are {:.3g} m long", height, sheet_.posts.length));
    impossible(layout_.block_centre.z() < 0.5 * edge,
               fmt::format("the block starts in the ground: its centre is {:.3g} m above it, its half edge "
                           "{:.3g} m; give block.height more",
                           layout_.block_centre.z(), 0.5 * edge));
    unusual(
        sheet_.block.speed < 25,
        fmt::format("block.speed is {:.3g} m/s; a type test asks for 25 m/s at least", sheet_.block.speed));
    unusual(sheet_.test.time < 0.3,
            fmt::format("test.time is {:.3g} s; braking takes 0.3 to 0.5 s", sheet_.test.time));
  }

  void look_at_energy() {
    const double energy = 0.5 * sheet_.block.mass * sheet_.block.speed * sheet_.block.speed;
    if (!sheet_.support_ropes.brakes) {
      unusual(energy > 100e3, fmt::format("there are no brakes for an impact of {:.3g} kJ", 1e-3 * energy));
      return;
    }
    const BrakeSheet& brakes = *sheet_.support_ropes.brakes;
    const double held = 4 * static_cast<double>(sheet_.support_ropes.number) * brakes.force * brakes.travel;
    unusual(held < 0.4 * energy, fmt::format("the brakes take {:.3g} kJ at their stops, {:.0f} % of the "
                                             "impact of {:.3g} kJ; 40 to 70 % is usual",
                                             1e-3 * held, 100 * held / energy, 1e-3 * energy));
  }

  const BarrierSheet& sheet_;
  const Layout& layout_;
  Findings findings_;
};

}  // namespace

Findings findings_of(const BarrierSheet& sheet, const Layout& layout) {
  return Inspection(sheet, layout).run();
}

}  // namespace talus::barrier
