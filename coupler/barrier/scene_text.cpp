#include "coupler/barrier/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "coupler/barrier/components.hpp"

namespace talus::barrier {

namespace {

using core::Vector3;

constexpr double steel_density = 7850;        // kg/m^3
constexpr double rope_modulus = 100e9;        // Pa, on the metallic area
constexpr double brake_mass_per_length = 10;  // kg/m, of one
constexpr std::array sides{"w", "e"};

std::string number(double value) {
  const double clean = std::abs(value) < 1e-9 ? 0 : value;  // round-off of sines
  return fmt::format("{:.7g}", clean);
}
std::string point(const Vector3& p) {
  return fmt::format("[{} m, {} m, {} m]", number(p.x()), number(p.y()), number(p.z()));
}
std::string direction(const Vector3& p) {
  return fmt::format("[{}, {}, {}]", number(p.x()), number(p.y()), number(p.z()));
}

class Writer {
 public:
  /// @param stage null: the plain scene of the sheet
  Writer(const LoadedSheet& loaded, const Layout& layout, const std::string& first_line, const Stage* stage)
      : title_(loaded.title),
        sheet_(loaded.sheet),
        layout_(layout),
        net_(find_net(sheet_.net.kind)),
        rings_(find_ring_net(sheet_.net.kind)),
        stage_(stage) {
    line(0, "# {}", first_line);
    line(0, "# x along the row, y up the slope, z off it; the ground is z = 0.");
  }

  std::string text() {
    line(0, "title: {}", nlohmann::json(title_).dump());  // quoted as YAML takes it, too
    line(0, "");
    line(0, "time: {{end: {} s, step: {} us}}  # test", number(stage_ ? stage_->end : sheet_.test.time),
         number(1e6 * step()));
    structure();
    if (has_block()) {
      particles();
      coupling();
    }
    output();
    return text_;
  }

 private:
  template <class... Args>
  void line(int indent, fmt::format_string<Args...> format, Args&&... args) {
    text_.append(static_cast<std::size_t>(2 * indent), ' ');
    text_ += fmt::format(format, std::forward<Args>(args)...) + "\n";
  }

  bool has_block() const { return !stage_ || stage_->has_block; }
  /// As the sheet has it, but a whole number of them makes the row.
  double cell_along() const {
    return layout_.net_length / std::max(1.0, std::round(layout_.net_length / sheet_.net.cell_along));
  }
  std::size_t posts() const { return layout_.feet.size(); }
  bool breaks() const { return sheet_.test.breaks == TestSheet::Breaks::at_breaking_load; }
  /// Of ropes side by side, as a key of their element.
  std::string strength(double newtons) const {
    return fmt::format("breaking_load: {0} N{1}", number(newtons),
                       breaks() ? fmt::format(", breaks: {{force: {} N}}", number(newtons)) : "");
  }
  double step() const { return sheet_.test.step.value_or(sheet_.support_ropes.friction ? 8e-6 : 25e-6); }
  std::string gravity() const {
    return direction(
        {0, -standard_gravity * std::sin(sheet_.slope), -standard_gravity * std::cos(sheet_.slope)});
  }

  void structure() {
    line(0, "\nstructure:");
    line(1, "gravity: {}  # m/s^2; of a slope of {} deg", gravity(),
         number(sheet_.slope * 180 / std::numbers::pi));
    if (stage_ && !stage_->start.empty())
      line(1, "start: {}", stage_->start);
    else if (!stage_ && sheet_.test.start == TestSheet::Start::hung)
      line(1, "start: {{relaxation: {{}}}}  # test.start: hung");
    line(1, "parts:");
    rings_ ? ring_net() : membrane();
    post_parts();
    anchor_ropes();
    support_ropes();
    node_sets();
    line(1, "weld: {{tolerance: 1 mm}}");
    supports();
    if (sheet_.ground) {
      line(1, "# ground: the lower ropes' radius stays above it");
      line(1, "obstacles:");
      line(2,
           "ground: {{plane: {{point: [0, 0, 0], normal: [0, 0, 1]}}, nodes: [net, lower], distance: {} m, "
           "friction: {}}}",
           number(0.5 * sheet_.support_ropes.diameter), number(sheet_.ground->friction));
    }
  }

  void ring_net() {
    line(2, "# net.kind {}: every ring is an element", sheet_.net.kind);
    line(2, "net:");
    line(3,
         "ring_net: {{corner: {}, size: [{} m, {} m], along: [1, 0, 0], across: {}, inner_diameter: {} m, "
         "wire_diameter: {} m, windings: {}}}",
         point(layout_.net_corner), number(layout_.net_length), number(layout_.net_height),
         direction(layout_.up_the_post), number(rings_->diameter), number(rings_->wire_diameter),
         rings_->windings);
    line(3, "ring: {}", breaks() ? "{breaks: {}}" : "{}");
  }

  void membrane() {
    line(2, "# net.kind {}: a membrane for its wires", net_->kind);
    line(2, "net:");
    line(
        3,
        "sheet: {{corner: {}, size: [{} m, {} m], along: [1, 0, 0], across: {}, crossed_cell: [{} m, {} m]}}",
        point(layout_.net_corner), number(layout_.net_length), number(layout_.net_height),
        direction(layout_.up_the_post), number(cell_along()), number(sheet_.net.cell_across));
    line(3, "membrane:");
    line(4, "thickness: {} m", number(net_->thickness));
    line(4, "density: {} kg/m^3", number(net_->density));
    line(4,
         "orthotropic: {{youngs_modulus_x: {} Pa, youngs_modulus_y: {} Pa, poissons_ratio_xy: {}, "
         "shear_modulus: {} Pa}}",
         number(net_->youngs_modulus_along), number(net_->youngs_modulus_across),
         number(net_->poissons_ratio), number(net_->shear_modulus));
    line(4, "material_axis: [1, 0, 0]");
    line(4, "tension_field: {{wrinkle_direction: iterated}}");
  }

  void post_parts() {
    const Profile& profile = *find_profile(sheet_.posts.profile);
    line(2, "# posts: hinged at their feet");
    for (std::size_t k = 0; k < posts(); ++k)
      line(2, "post_{}: {{polyline: {{points: [{}, {}]}}, bar: {}}}", k + 1, point(layout_.feet[k]),
           point(layout_.heads[k]),
           k > 0 ? "*post"
                 : fmt::format("&post {{area: {} m^2, density: {} kg/m^3, youngs_modulus: 210 GPa, "
                               "second_moment: {} m^4}}",
                               number(profile.area), number(steel_density), number(profile.second_moment)));
  }

  std::string cable_of(double diameter, const char* anchor) const {
    const Rope& rope = *find_rope(diameter);
    return fmt::format("&{} {{area: {} m^2, density: {} kg/m^3, youngs_modulus: {} Pa, {}}}", anchor,
                       number(rope.area), number(steel_density), number(rope_modulus),
                       strength(rope.breaking_load));
  }

  void anchor_ropes() {
    line(2, "# retaining_ropes: two a post, to anchors midway between the posts");
    for (std::size_t k = 0; k < posts(); ++k)
      for (const std::size_t side : {0U, 1U})
        line(2, "retaining_{}{}: {{polyline: {{points: [{}, {}]}}, cable: {}}}", k + 1, sides[side],
             point(layout_.retaining_anchors[k + side]), point(layout_.heads[k]),
             k + side > 0 ? "*retaining" : cable_of(sheet_.retaining_ropes.diameter, "retaining"));
    line(2, "# lateral_ropes");
    for (const std::size_t side : {0U, 1U})
      line(2, "lateral_{}: {{polyline: {{points: [{}, {}]}}, cable: {}}}", sides[side],
           point(layout_.lateral_anchor[side]), point(layout_.heads[side == 0 ? 0 : posts() - 1]),
           side > 0 ? "*lateral" : cable_of(sheet_.lateral_ropes.diameter, "lateral"));
  }

  void support_ropes() {
    const SupportRopeSheet& ropes = sheet_.support_ropes;
    const Rope& rope = *find_rope(ropes.diameter);
    const auto count = static_cast<double>(ropes.number);
    if (ropes.brakes)
      brakes(*ropes.brakes);
    else
      end_pieces(fmt::format("&piece {{area: {} m^2, density: {} kg/m^3, youngs_modulus: {} Pa, {}}}",
                             number(count * rope.area), number(steel_density), number(rope_modulus),
                             strength(count * rope.breaking_load)));
    line(2, "# support_ropes: {} side by side written as one, through all posts and the net's edge",
         ropes.number);
    for (const bool upper : {true, false}) {
      std::string nodes = end_part(upper, 0) + ".end";
      for (std::size_t k = 0; k < posts(); ++k) {
        nodes += fmt::format(", post_{}.{}", k + 1, upper ? "end" : "start");
        if (k + 1 < posts()) nodes += fmt::format(", {}_{}", upper ? "top" : "bottom", k + 1);
      }
      nodes += ", " + end_part(upper, 1) + ".end";
      line(2, "{}:", upper ? "upper" : "lower");
      line(3, "through: {{nodes: [{}]}}", nodes);
      const std::string friction =
          ropes.friction ? fmt::format(", friction: {}", number(*ropes.friction)) : "";
      line(3, "sliding_cable: {{area: {} m^2, density: {} kg/m^3, youngs_modulus: {} Pa, {}{}}}",
           number(count * rope.area), number(steel_density), number(rope_modulus),
           strength(count * rope.breaking_load), friction);
    }
    const Rope& side = *find_rope(sheet_.retaining_ropes.diameter);
    line(2, "# the net's edges beside the first and the last post, on ropes like the retaining ones");
    for (const std::size_t k : {0U, 1U}) {
      const std::size_t post = k == 0 ? 1 : posts();
      // A sheet's edges run round it: the western one down, the eastern one up.
      line(2, "side_{}: {{through: {{nodes: [post_{}.{}, net.edge_{}, post_{}.{}]}}, sliding_cable: {}}}",
           sides[k], post, k == 0 ? "end" : "start", k == 0 ? "west" : "east", post, k == 0 ? "start" : "end",
           k > 0 ? "*side"
                 : fmt::format("&side {{area: {} m^2, density: {} kg/m^3, youngs_modulus: {} Pa, {}}}",
                               number(side.area), number(steel_density), number(rope_modulus),
                               strength(side.breaking_load)));
    }
  }

  std::string end_part(bool upper, std::size_t side) const {
    return fmt::format("{}_{}{}", sheet_.support_ropes.brakes ? "brake" : "anchor", upper ? "u" : "l",
                       sides[side]);
  }

  void end_pieces(const std::string& cable) {
    line(2, "# support_ropes without brakes: their last metre, on which nothing slides");
    for (const bool upper : {true, false})
      for (const std::size_t side : {0U, 1U})
        line(2, "{}: {{polyline: {{points: [{}, {}]}}, cable: {}}}", end_part(upper, side),
             point(upper ? layout_.upper_anchor[side] : layout_.lower_anchor[side]),
             point(upper ? layout_.upper_end[side] : layout_.lower_end[side]),
             upper && side == 0 ? cable : "*piece");
  }

  void brakes(const BrakeSheet& brake) {
    const auto count = static_cast<double>(sheet_.support_ropes.number);
    const double force = count * brake.force;
    line(2,
         "# support_ropes.brakes: each stands for {}; linear to 80 % at 20 mm, full force at 0.1 m, 10 % "
         "more at the end",
         sheet_.support_ropes.number);
    bool first = true;
    for (const bool upper : {true, false})
      for (const std::size_t side : {0U, 1U}) {
        const Vector3& anchor = upper ? layout_.upper_anchor[side] : layout_.lower_anchor[side];
        const Vector3& end = upper ? layout_.upper_end[side] : layout_.lower_end[side];
        line(2, "{}: {{polyline: {{points: [{}, {}]}}, brake: {}}}", end_part(upper, side), point(anchor),
             point(end),
             !first ? "*brake"
                    : fmt::format("&brake {{table: [[20 mm, {} N], [0.1 m, {} N], [{} m, {} N]], "
                                  "mass_per_length: {} kg/m, "
                                  "end_stop: {{stiffness: 10 MN/m, width: 50 mm}}}}",
                                  number(0.8 * force), number(force), number(brake.travel),
                                  number(1.1 * force), number(count * brake_mass_per_length)));
        first = false;
      }
  }

  /// The nodes of the net's edge between two posts, without those at the posts.
  void node_sets() {
    line(1, "node_sets:");
    const Vector3 low = layout_.net_corner, high = low + layout_.net_height * layout_.up_the_post;
    for (const bool upper : {true, false})
      for (std::size_t k = 0; k + 1 < posts(); ++k) {
        const Vector3& edge = upper ? high : low;
        const Vector3 half(0, 0.02, 0.02);
        Vector3 from = edge - half, to = edge + half;
        from.x() = layout_.feet[k].x() + 0.1;
        to.x() = layout_.feet[k + 1].x() - 0.1;
        line(2, "{}_{}: {{box: {{low: {}, high: {}}}}}", upper ? "top" : "bottom", k + 1, point(from),
             point(to));
      }
  }

  void supports() {
    line(1, "supports:");
    for (std::size_t k = 0; k < posts(); ++k) line(2, "- {{nodes: post_{}.start, fix: xyz}}", k + 1);
    // Neighbours share an anchor: the eastern rope of a post and the western one of the next.
    line(2, "- {{nodes: retaining_1w.start, fix: xyz}}");
    for (std::size_t k = 0; k < posts(); ++k) line(2, "- {{nodes: retaining_{}e.start, fix: xyz}}", k + 1);
    for (const char* side : sides) line(2, "- {{nodes: lateral_{}.start, fix: xyz}}", side);
    for (const bool upper : {true, false})
      for (const std::size_t side : {0U, 1U})
        line(2, "- {{nodes: {}.start, fix: xyz}}", end_part(upper, side));
  }

  void particles() {
    const BlockSheet& block = sheet_.block;
    line(0, "\nparticles:");
    line(1, "gravity: {}  # m/s^2", gravity());
    line(1, "implicit_contact: {{}}");
    line(1, "materials:");
    line(2, "concrete: {{density: {} kg/m^3, youngs_modulus: 20 MPa, poissons_ratio: 0.2}}",
         number(block.density));
    line(2, "wire: {{youngs_modulus: 1e20 Pa, poissons_ratio: 0.25}}");
    if (sheet_.ground) line(2, "soil: {{youngs_modulus: 1e20 Pa, poissons_ratio: 0.25}}");
    line(1, "contacts:");
    line(2, "- {{between: [concrete, wire], hertz: {{restitution: 0.2}}, friction: {{coefficient: 0.4}}}}");
    if (sheet_.ground)
      line(2, "- {{between: [concrete, soil], hertz: {{restitution: 0.2}}, friction: {{coefficient: {}}}}}",
           number(sheet_.ground->friction));
    line(1, "rocks:");
    line(2, "# block: a face parallel to the net, {} mm in front of it", number(1e3 * block.distance));
    line(2, "block:");
    line(3, "material: concrete");
    line(3, "block: {{form: {}, mass: {} kg, deviation: {} m}}",
         block.form == BlockSheet::Form::eota_221 ? "eota_221" : "eota_111", number(block.mass),
         number(0.05 * layout_.block_edge));
    line(3, "at: {}", point(layout_.block_centre));
    line(3, "velocity: [0 m/s, {} m/s, 0 m/s]", number(-block.speed));
    if (block.spin.norm() > 0)
      line(3, "spin: [{} rad/s, {} rad/s, {} rad/s]", number(block.spin.x()), number(block.spin.y()),
           number(block.spin.z()));
    // The flat block's short axis is its z.
    const double turn = block.form == BlockSheet::Form::eota_221 ? -std::numbers::pi / 2 - sheet_.posts.lean
                                                                 : -sheet_.posts.lean;
    line(3, "turned: [{} rad, 0 rad, 0 rad]", number(turn));
    if (sheet_.ground)
      line(1, "planes: {{ground: {{material: soil, point: [0 m, 0 m, 0 m], normal: [0, 0, 1]}}}}");
  }

  void coupling() {
    line(0, "\ninterface:");
    line(1, "structure: [net]");
    line(1, "boundary:");
    if (rings_)
      line(2, "same_as_structure: {{material: wire}}");
    else
      wires();
    line(0, "\ncoupling:");
    line(1, "serial_explicit: {{}}");
  }

  void wires() {
    // Wires where the block may touch: the spans beside the hit, whole meshes.
    const double mesh = net_->diagonal_along, reach = 0.5 * sheet_.posts.spacing + layout_.block_edge;
    const double low = std::max(0.0, std::floor((layout_.hit.x() - reach) / mesh)) * mesh;
    const double high =
        std::min(std::floor(layout_.net_length / mesh + 1e-9), std::ceil((layout_.hit.x() + reach) / mesh)) *
        mesh;
    const Vector3 corner = layout_.net_corner + Vector3(low, 0, 0);
    line(2,
         "rhombic_net: {{corner: {}, size: [{} m, {} m], along: [1, 0, 0], across: {}, diagonals: [{} m, {} "
         "m], wire_diameter: {} m, material: wire}}",
         point(corner), number(high - low), number(meshes_across() * net_->diagonal_across),
         direction(layout_.up_the_post), number(net_->diagonal_along), number(net_->diagonal_across),
         number(net_->wire_diameter));
  }
  double meshes_across() const { return std::floor(layout_.net_height / net_->diagonal_across + 1e-6); }

  void output() {
    line(0, "\noutput:");
    line(1, "every: 1 ms");
    line(1, "fields_every: 10 ms");
    line(1, "largest_forces: {{}}");
    if (stage_) line(1, "final_state: {{}}");
    line(1, "probes:");
    if (has_block()) line(2, "block: {{rock: block}}");
    line(2, "middle: {{at: {}, part: net}}", point(nearest_net_node()));
    for (const char* part : {"net", "upper", "lower", "side_w", "side_e", "lateral_w", "lateral_e"})
      line(2, "{0}: {{part: {0}}}", part);
    for (std::size_t k = 1; k <= posts(); ++k) {
      line(2, "post_{0}: {{part: post_{0}}}", k);
      for (const char* side : sides) line(2, "retaining_{0}{1}: {{part: retaining_{0}{1}}}", k, side);
    }
    if (!sheet_.support_ropes.brakes) return;
    for (const bool upper : {true, false})
      for (const std::size_t side : {0U, 1U}) line(2, "{0}: {{part: {0}}}", end_part(upper, side));
  }
  Vector3 nearest_net_node() const {
    const double up =
        std::clamp((layout_.hit - layout_.net_corner).dot(layout_.up_the_post), 0.0, layout_.net_height);
    if (rings_) {  // where a ring touches the next one along the row
      const double d = rings_->diameter,
                   row = std::floor(std::min(up, layout_.net_height - 0.5 * d) / d) + 0.5;
      return layout_.net_corner + Vector3(std::round(layout_.hit.x() / d) * d, 0, 0) +
             row * d * layout_.up_the_post;
    }
    const double x = std::round(layout_.hit.x() / cell_along()) * cell_along();
    return layout_.net_corner + Vector3(x, 0, 0) +
           std::round(up / sheet_.net.cell_across) * sheet_.net.cell_across * layout_.up_the_post;
  }

  std::string title_;
  const BarrierSheet& sheet_;
  const Layout& layout_;
  const Net* net_;  ///< null: rings
  std::optional<RingNet> rings_;
  const Stage* stage_;
  std::string text_;
};

}  // namespace

std::string scene_text(const LoadedSheet& loaded, const Layout& layout, const std::string& from) {
  return Writer(loaded, layout,
                fmt::format("Written by `talus barrier {}`; edit the sheet, or this scene itself.", from),
                nullptr)
      .text();
}

std::string stage_text(const LoadedSheet& loaded, const Layout& layout, const Stage& stage) {
  return Writer(loaded, layout, stage.purpose, &stage).text();
}

std::string assumptions(const BarrierSheet& sheet) {
  std::string text;
  const auto add = [&text](const std::string& what) { text += "  default, verify: " + what + "\n"; };
  add("ropes have 1770 MPa wire, 100 GPa on their metallic area, and the breaking loads of the trade's "
      "tables");
  add("a brake's force rises to 80 % at 20 mm, is whole at 0.1 m and 10 % more at its end; stop of 10 MN/m");
  if (find_ring_net(sheet.net.kind))
    add("rings bend and stretch as three chains of three rings of 3 mm wire did, and give nearly nothing "
        "back");
  if (!sheet.support_ropes.friction)
    add("support ropes slide without friction (friction: 0.1 to 0.3 is measured)");
  add("the block's contact with wires has 20 MPa, restitution 0.2 and friction 0.4");
  return text;
}

}  // namespace talus::barrier
