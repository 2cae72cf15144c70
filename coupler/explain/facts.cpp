#include "coupler/explain/facts.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/errors.hpp"
#include "core/output/field_reader.hpp"

namespace talus::explain {
namespace {

namespace fs = std::filesystem;

bool has_field(const core::GroupDescription& group, const std::string& name) {
  return std::ranges::any_of(group.fields, [&](const auto& field) { return field.name == name; });
}

void add_line_forces(const core::FieldReader& fields, const core::GroupDescription& group, std::int64_t frame,
                     PartFacts& part) {
  for (const double force : fields.read(group, "axial_force", frame)) {
    part.tension = std::max(part.tension, force);
    part.compression = std::max(part.compression, -force);
  }
}

/// Principal stresses of every triangle: centre +- radius of Mohr's circle.
void add_sheet_stresses(const core::FieldReader& fields, const core::GroupDescription& group,
                        std::int64_t frame, PartFacts& part) {
  const auto xx = fields.read(group, "stress_xx", frame), yy = fields.read(group, "stress_yy", frame),
             xy = fields.read(group, "stress_xy", frame);
  for (std::size_t i = 0; i < xx.size(); ++i) {
    const double centre = 0.5 * (xx[i] + yy[i]), radius = std::hypot(0.5 * (xx[i] - yy[i]), xy[i]);
    part.tension = std::max(part.tension, centre + radius);
    part.compression = std::max(part.compression, radius - centre);
  }
  if (!has_field(group, "wrinkle_state")) return;
  const auto states = fields.read(group, "wrinkle_state", frame);
  part.gave_way = part.gave_way.value_or(false) ||
                  std::ranges::any_of(states, [](const double state) { return state != 0; });
}

std::vector<PartFacts> parts_of(const fs::path& file) {
  std::vector<PartFacts> parts;
  if (!fs::exists(file)) return parts;
  const core::FieldReader fields(file);
  for (const auto& group : fields.groups()) {
    const bool line = has_field(group, "axial_force"), sheet = has_field(group, "stress_xx");
    if (!line && !sheet) continue;
    PartFacts part{.name = group.name, .kind = line ? PartFacts::Kind::line : PartFacts::Kind::sheet};
    part.frames = fields.frames();
    for (std::int64_t frame = 0; frame < part.frames; ++frame)
      line ? add_line_forces(fields, group, frame, part) : add_sheet_stresses(fields, group, frame, part);
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

double ResultFacts::impact() const {
  return summary.value("/energy/impact_J"_json_pointer, 0.0);
}

std::optional<double> ResultFacts::largest(const std::string& line) const {
  const auto* values = energy.column(line);
  if (!values) return std::nullopt;
  double largest = 0;
  for (const double joules : *values) largest = std::max(largest, std::abs(joules));
  return largest;
}

const EffectFacts* ResultFacts::against(const std::string& limit) const {
  const auto found = std::ranges::find(effects, limit, &EffectFacts::limit);
  return found == effects.end() || limit.empty() ? nullptr : &*found;
}

std::vector<EffectFacts> effects_of(const nlohmann::json& summary) {
  std::vector<EffectFacts> effects;
  for (const auto& effect : summary.value("effects", nlohmann::json::array()))
    effects.push_back({.side = effect.at("side"),
                       .name = effect.at("name"),
                       .key = effect.value("key", ""),
                       .ledger_line = effect.value("ledger_line", ""),
                       .limit = effect.value("limit", ""),
                       .present = effect.at("present"),
                       .may_hold = effect.value("may_hold", false)});
  return effects;
}

ResultFacts read_facts(const fs::path& result) {
  std::ifstream summary(result / "summary.json");
  if (!summary)
    throw core::ConfigError("'" + result.string() + "' holds no result: there is no summary.json");
  ResultFacts facts{.summary = nlohmann::json::parse(summary),
                    .energy = core::read_table(result / "energy.csv"),
                    .parts = parts_of(result / "fields.h5"),
                    .effects = {}};
  facts.effects = effects_of(facts.summary);
  return facts;
}

}  // namespace talus::explain
