#include "coupler/barrier/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "core/output/field_reader.hpp"
#include "core/output/table.hpp"
#include "coupler/barrier/channel_filter.hpp"
#include "coupler/barrier/components.hpp"

namespace talus::barrier {

namespace {

namespace fs = std::filesystem;
using core::Vector3;
using nlohmann::json;

const core::GroupDescription* group_of(const core::FieldReader& fields, const std::string& part) {
  for (const auto& group : fields.groups())
    if (group.name == part) return &group;
  return nullptr;
}

/// x, y, z of every node of a part.
std::vector<Vector3> places(const core::FieldReader& fields, const core::GroupDescription& group,
                            std::int64_t frame) {
  const std::vector<double> values = fields.read(group, "position", frame);
  std::vector<Vector3> points;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  return points;
}

/// The table of one impact's probes.
class Curves {
 public:
  explicit Curves(const fs::path& file) : table_(core::read_table(file)) {}
  const std::vector<double>& time() const { return table_.columns.front(); }
  const std::vector<double>& of(const std::string& name) const {
    const auto* column = table_.column(name);
    if (!column) throw core::ConfigError("the result has no probe column '" + name + "'");
    return *column;
  }
  std::vector<Vector3> vectors(const std::string& quantity, const std::string& unit) const {
    std::vector<Vector3> all;
    for (std::size_t i = 0; i < time().size(); ++i)
      all.emplace_back(of(quantity + "_x_" + unit)[i], of(quantity + "_y_" + unit)[i],
                       of(quantity + "_z_" + unit)[i]);
    return all;
  }

 private:
  core::Table table_;
};

std::vector<double> negative(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}
std::vector<double> lengths(const std::vector<Vector3>& vectors) {
  std::vector<double> all;
  for (const Vector3& v : vectors) all.push_back(v.norm());
  return all;
}
double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

/// Vectors filtered component by component: their lengths.
std::vector<double> filtered(const std::vector<Vector3>& vectors, double interval, double channel_class) {
  std::vector<double> components[3];
  for (int c = 0; c < 3; ++c) {
    for (const Vector3& v : vectors) components[c].push_back(v[c]);
    components[c] = channel_filtered(components[c], interval, channel_class);
  }
  std::vector<double> sizes;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    sizes.push_back(std::hypot(components[0][i], components[1][i], components[2][i]));
  return sizes;
}

/// The nodes of the two support ropes across from each other, in the span that is hit.
struct FacingNodes {
  const core::GroupDescription *upper = nullptr, *lower = nullptr;
  std::vector<std::size_t> nodes;  ///< the same number in both ropes
};
FacingNodes facing_nodes(const core::FieldReader& fields, const BarrierSheet& sheet, const Layout& layout) {
  FacingNodes facing{group_of(fields, "upper"), group_of(fields, "lower"), {}};
  if (!facing.upper || !facing.lower) return facing;
  const double spacing = sheet.posts.spacing;
  const double first =
      std::clamp(std::floor(layout.hit.x() / spacing), 0.0, static_cast<double>(sheet.posts.count - 2)) *
      spacing;
  const auto upper = places(fields, *facing.upper, 0), lower = places(fields, *facing.lower, 0);
  const double inside = 0.02 * spacing;
  for (std::size_t i = 0; i < std::min(upper.size(), lower.size()); ++i)
    if (upper[i].x() > first + inside && upper[i].x() < first + spacing - inside) facing.nodes.push_back(i);
  return facing;
}

/// Normal to the slope between the ropes, at the lowest place of the span (m); nothing without the ropes' fields.
std::optional<double> height_at(const core::FieldReader& fields, const FacingNodes& facing,
                                std::int64_t frame) {
  if (facing.nodes.empty()) return std::nullopt;
  const auto upper = places(fields, *facing.upper, frame), lower = places(fields, *facing.lower, frame);
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t node : facing.nodes) least = std::min(least, upper[node].z() - lower[node].z());
  return least;
}

json or_null(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

/// The lowest place of net and block above the ground, up to a time, the block with the farthest of its points down (m).
std::optional<double> clearance(const core::FieldReader& fields, const Curves& curves, const Layout& layout,
                                double until) {
  const auto* net = group_of(fields, "net");
  if (!net) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t frame = 0; frame < fields.frames(); ++frame) {
    if (fields.times()[static_cast<std::size_t>(frame)] > until) break;
    for (const Vector3& place : places(fields, *net, frame)) least = std::min(least, place.z());
  }
  const auto& z = curves.of("block.position_z_m");
  for (std::size_t i = 0; i < z.size() && curves.time()[i] <= until; ++i)
    least = std::min(least, z[i] - reach_of_block * layout.block_edge);
  return least;
}

std::string kind_of(const std::string& part) {
  const auto begins = [&](const char* word) { return part.starts_with(word); };
  if (part == "upper" || part == "lower" || begins("anchor_")) return "support rope";
  if (begins("retaining_")) return "retaining rope";
  if (begins("lateral_")) return "lateral rope";
  if (begins("side_")) return "side rope";
  if (begins("post_")) return "post";
  if (begins("brake_")) return "brake";
  return "other";
}

/// A table of the summary, empty where the result has none.
const json& table_of(const json& summary, const char* name) {
  static const json none = json::object();
  const auto tables = summary.find("tables");
  return tables != summary.end() && tables->contains(name) ? tables->at(name) : none;
}

json forces(const json& summary) {
  json rows = json::array();
  const json &used = table_of(summary, "utilisation"), &buckling = table_of(summary, "buckling");
  for (const auto& [part, row] : table_of(summary, "largest_forces").items()) {
    const double pull = row.at("tension_N"), press = row.at("compression_N");
    const bool pressed = press > pull;
    json limit = nullptr, utilisation = nullptr;
    if (const json& limits = pressed ? buckling : used; limits.contains(part)) {
      limit = limits.at(part).at(pressed ? "buckling_load_N" : "breaking_load_N");
      utilisation = limits.at(part).at("utilisation");
    }
    rows.push_back({{"part", part},
                    {"kind", kind_of(part)},
                    {"force_N", std::max(pull, press)},
                    {"time_s", row.at(pressed ? "compression_time_s" : "tension_time_s")},
                    {"tension_N", pull},
                    {"compression_N", press > 0 ? json(press) : json(nullptr)},
                    {"limit_N", limit},
                    {"utilisation", utilisation}});
  }
  return rows;
}

json brakes(const json& summary, const Curves& curves, const BarrierSheet& sheet) {
  json rows = json::array();
  if (!sheet.support_ropes.brakes) return rows;
  const double available = sheet.support_ropes.brakes->travel;
  for (const auto& [part, row] : table_of(summary, "largest_forces").items()) {
    if (kind_of(part) != "brake") continue;
    const double travel = largest(curves.of(part + ".travel_max_m"));
    rows.push_back({{"part", part},
                    {"travel_m", travel},
                    {"available_m", available},
                    {"share", travel / available},
                    {"stop_reached", travel >= available},
                    {"force_N", row.at("tension_N")}});
  }
  return rows;
}

/// Where a support of the barrier's scene stands: "retaining_1w.start" and the like.
std::optional<Vector3> anchor_place(const std::string& support, const Layout& layout) {
  const std::string part = support.substr(0, support.find('.'));
  const std::size_t side = part.ends_with("e") ? 1 : 0;
  if (part.starts_with("retaining_")) {
    const auto post = static_cast<std::size_t>(std::stoul(part.substr(10)));
    return layout.retaining_anchors[post - 1 + side];
  }
  if (part.starts_with("post_")) return layout.feet[static_cast<std::size_t>(std::stoul(part.substr(5))) - 1];
  if (part.starts_with("lateral_")) return layout.lateral_anchor[side];
  if (part.find("_u") != std::string::npos) return layout.upper_anchor[side];
  if (part.find("_l") != std::string::npos) return layout.lower_anchor[side];
  return std::nullopt;
}

json anchors(const json& summary, const Layout& layout) {
  constexpr double degrees = 180 / std::numbers::pi;
  json rows = json::array();
  for (const auto& [name, row] : table_of(summary, "support_forces").items()) {
    const Vector3 pull = -Vector3(row.at("x_N"), row.at("y_N"), row.at("z_N"));  // on the anchor
    const auto place = anchor_place(name, layout);
    const double across = std::hypot(pull.x(), pull.y());
    rows.push_back({{"name", name},
                    {"at", place ? json{place->x(), place->y(), place->z()} : json(nullptr)},
                    {"force_N", {pull.x(), pull.y(), pull.z()}},
                    {"size_N", row.at("force_N")},
                    {"time_s", row.at("time_s")},
                    {"above_ground_deg", degrees * std::atan2(pull.z(), across)},
                    {"in_plan_deg", degrees * std::atan2(pull.y(), pull.x())}});
  }
  return rows;
}

/// Which of the shares a line of the ledger belongs to; nothing for what is not a place where energy goes.
std::optional<std::string> share_of(const std::string& line) {
  const auto has = [&](const char* word) { return line.find(word) != std::string::npos; };
  if (has("particles.kinetic")) return "block in motion";
  if (has("dissipated_brake") || has("elastic_brake")) return "brakes";
  if (has("elastic_net")) return "net";
  if (has("elastic_post")) return "posts";
  if (has("structure.elastic_")) return "ropes";
  if (has("dissipated_")) return "friction of ropes and broken parts";
  if (has("structure.kinetic")) return "barrier in motion";
  if (has("contacts.")) return "contact of block and net";
  if (has("bulk_damping")) return "damping";
  if (has("structure.gravity")) return "weight of the barrier";
  return std::nullopt;
}

json energy(const fs::path& result, double at_peak) {
  const core::Table table = core::read_table(result / "energy.csv");
  if (table.rows() == 0) return nullptr;
  const auto& time = table.columns.front();
  const auto peak = std::min(static_cast<std::size_t>(std::ranges::lower_bound(time, at_peak) - time.begin()),
                             time.size() - 1);
  std::vector<std::string> order;
  json joules = json::object();
  double input[2] = {0, 0};
  for (std::size_t k = 1; k < table.columns.size(); ++k) {
    const double values[2] = {table.columns[k][peak], table.columns[k].back()};
    const double start = table.columns[k].front();
    if (table.names[k] == "particles.kinetic_J" || table.names[k] == "particles.kinetic_rotation_J")
      for (double& sum : input) sum += start;
    if (table.names[k] == "particles.gravity_J")
      for (int i : {0, 1}) input[i] += values[i] - start;
    const auto share = share_of(table.names[k]);
    if (!share) continue;
    const double from = *share == "block in motion" ? 0 : start;  // prestress and sag were there before
    if (!joules.contains(*share)) {
      joules[*share] = {0.0, 0.0};
      order.push_back(*share);
    }
    for (int i : {0, 1}) joules[*share][i] = joules[*share][i].get<double>() + values[i] - from;
  }
  json rows = json::array();
  for (const auto& share : order) rows.push_back({{"name", share}, {"J", joules[share]}});
  return {{"columns", {"largest elongation", "end"}}, {"rows", rows}, {"input_J", {input[0], input[1]}}};
}

/// Null where nothing can break.
json broken(const json& summary) {
  if (table_of(summary, "ruptures").empty()) return nullptr;
  json rows = json::array();
  for (const auto& [part, row] : table_of(summary, "ruptures").items())
    if (row.at("broken").get<double>() > 0)
      rows.push_back({{"part", part},
                      {"count", row.at("broken")},
                      {"first_s", row.at("first_time_s")},
                      {"force_N", row.at("first_force_N")}});
  std::sort(rows.begin(), rows.end(),
            [](const json& a, const json& b) { return a.at("first_s") < b.at("first_s"); });
  return rows;
}

/// Heights at the times of the curves, from the frames before them.
json heights(const core::FieldReader& fields, const FacingNodes& facing, const std::vector<double>& time) {
  json values = json::array();
  if (facing.nodes.empty() || fields.frames() == 0) return values;
  std::int64_t frame = 0;
  std::optional<double> height = height_at(fields, facing, 0);
  for (const double now : time) {
    while (frame + 1 < fields.frames() && fields.times()[static_cast<std::size_t>(frame + 1)] <= now + 1e-9)
      height = height_at(fields, facing, ++frame);
    values.push_back(or_null(height));
  }
  return values;
}

}  // namespace

double net_reaches(const fs::path& result, const Layout& layout) {
  const core::FieldReader fields(result / "fields.h5");
  const auto* net = group_of(fields, "net");
  if (!net || fields.frames() == 0)
    throw core::ConfigError("'" + result.string() + "' holds no fields of the net");
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector3& place : places(fields, *net, fields.frames() - 1))
    if (std::abs(place.x() - layout.hit.x()) < layout.block_edge &&
        std::abs(place.z() - layout.block_centre.z()) < layout.block_edge)
      highest = std::max(highest, place.y());
  return std::isfinite(highest) ? highest : layout.hit.y();
}

json measured(const fs::path& result, const BarrierSheet& sheet, const Layout& layout) {
  std::ifstream file(result / "summary.json");
  if (!file) throw core::ConfigError("'" + result.string() + "' holds no result: there is no summary.json");
  const json summary = json::parse(file);
  const Curves curves(result / "probes.csv");
  const core::FieldReader fields(result / "fields.h5");
  const auto& time = curves.time();
  const double interval = time.size() > 1 ? time[1] - time[0] : 1e-3, mass = sheet.block.mass;

  const auto push = curves.vectors("block.contact_force", "N");
  std::vector<Vector3> acceleration;
  for (const Vector3& force : push) acceleration.push_back(force / mass);
  const std::vector<double> raw = lengths(acceleration), cfc180 = filtered(acceleration, interval, 180),
                            cfc60 = filtered(acceleration, interval, 60);
  const std::vector<double> elongation = negative(curves.of("middle.displacement_y_m"));
  const std::vector<double> speed = lengths(curves.vectors("block.velocity", "m_per_s"));

  const auto touched = std::ranges::find_if(raw, [](double a) { return a > 0; });
  const auto peak = std::ranges::max_element(elongation);
  const double peak_time = time[static_cast<std::size_t>(peak - elongation.begin())];
  const auto first = touched == raw.end() ? 0 : static_cast<std::size_t>(touched - raw.begin());
  json contact = nullptr, braking = nullptr;
  if (touched != raw.end()) {
    contact = time[first];
    braking = peak_time - time[first];
  }
  const auto down = curves.of("block.velocity_y_m_per_s");
  const bool stopped = std::ranges::any_of(down, [](double v) { return v >= 0; });
  const auto& path = curves.of("block.position_y_m");
  const double way =
      path[first] - *std::ranges::min_element(path);  // along the slope, from the first contact on
  const double meets =
      speed[first > 0 ? first - 1 : 0];  // the row before the touch: behind it the net has pushed
  const double impact = 0.5 * mass * meets * meets;

  const FacingNodes facing = facing_nodes(fields, sheet, layout);
  const auto nominal = height_at(fields, facing, 0),
             residual = height_at(fields, facing, fields.frames() - 1);
  json data{{"finished", summary.value("status", "") == "finished"},
            {"block_mass_kg", mass},
            {"energy_kJ", 1e-3 * impact},
            {"speed_m_per_s", meets},
            {"first_contact_s", contact},
            {"stopped", stopped},
            {"largest_elongation_m", *peak},
            {"largest_elongation_s", peak_time},
            {"braking_time_s", braking},
            {"nominal_height_m", or_null(nominal)},
            {"residual_height_m", or_null(residual)},
            {"residual_share", nominal && residual ? json(*residual / *nominal) : json(nullptr)},
            {"clearance_m", or_null(clearance(fields, curves, layout, peak_time))},
            {"mean_braking_force_N",
             way > 0 ? json((impact + mass * standard_gravity * std::sin(sheet.slope) * way) / way)
                     : json(nullptr)},
            {"peak_acceleration_raw", largest(raw)},
            {"peak_acceleration_cfc180", largest(cfc180)},
            {"peak_acceleration_cfc60", largest(cfc60)},
            {"curves",
             {{"time_s", time},
              {"elongation_m", elongation},
              {"speed_m_per_s", speed},
              {"acceleration_raw", raw},
              {"acceleration_cfc180", cfc180},
              {"acceleration_cfc60", cfc60},
              {"height_m", heights(fields, facing, time)}}},
            {"forces", forces(summary)},
            {"brakes", brakes(summary, curves, sheet)},
            {"anchors", anchors(summary, layout)},
            {"energy", energy(result, peak_time)},
            {"broken", broken(summary)},
            {"warnings", summary.value("warnings", json::array())},
            {"wall_s", summary.value("wall_time_s", json(nullptr))},
            {"step_s", summary.value("window_s", json(nullptr))}};
  data["energy_error"] = summary.contains("energy")
                             ? summary.at("energy").value("largest_error_relative", json(nullptr))
                             : json(nullptr);
  return data;
}

}  // namespace talus::barrier
