#include "coupler/c_api/descriptions.hpp"

#include "coupler/c_api/given.hpp"

namespace talus::c_api {
namespace {

template <std::size_t nodes>
std::vector<std::array<mesh::Index, nodes>> cells(std::span<const std::int32_t> corners) {
  std::vector<std::array<mesh::Index, nodes>> made(corners.size() / nodes);
  for (std::size_t k = 0; k < made.size(); ++k)
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(k * nodes), nodes, made[k].begin());
  return made;
}

std::vector<double> doubles(const double* first, std::int64_t count, std::size_t width, const char* member) {
  const auto given = values(first, count, width, member);
  return {given.begin(), given.end()};
}

std::vector<std::string> texts(const char* const* first, std::int64_t count, const char* member) {
  std::vector<std::string> made;
  for (const char* const one : values(first, count, 1, member)) made.push_back(text(one, member));
  return made;
}

}  // namespace

mesh::SurfacePart part_from(const talus_part* said) {
  const talus_part part = taken(said, "talus_part");
  return {.name = text(part.name, "talus_part.name"),
          .material = optional_text(part.material),
          .wire_radius = part.wire_radius,
          .segment_begin = static_cast<mesh::Index>(part.segment_begin),
          .segment_end = static_cast<mesh::Index>(part.segment_end),
          .triangle_begin = static_cast<mesh::Index>(part.triangle_begin),
          .triangle_end = static_cast<mesh::Index>(part.triangle_end)};
}

mesh::Surface surface_from(const talus_surface& said, const std::vector<mesh::SurfacePart>& parts) {
  mesh::Surface surface{
      .positions = doubles(said.positions, said.nodes, 3, "talus_surface.positions"),
      .segments = cells<2>(values(said.segment_nodes, said.segments, 2, "talus_surface.segment_nodes")),
      .triangles = cells<3>(values(said.triangle_nodes, said.triangles, 3, "talus_surface.triangle_nodes")),
      .parts = parts};
  if (said.start != nullptr) surface.start = doubles(said.start, said.nodes, 3, "talus_surface.start");
  if (parts.empty())
    surface.parts = {{.name = "surface",
                      .segment_end = static_cast<mesh::Index>(said.segments),
                      .triangle_end = static_cast<mesh::Index>(said.triangles)}};
  return surface;
}

coupler::StepLimit limit_from(const talus_limit* said) {
  const talus_limit limit = taken(said, "talus_limit");
  return {.name = text(limit.name, "talus_limit.name"),
          .seconds = limit.seconds,
          .stability = limit.only_accuracy == 0,
          .reason = optional_text(limit.reason)};
}

coupler::Effect effect_from(const talus_effect* said) {
  const talus_effect effect = taken(said, "talus_effect");
  return {.name = text(effect.name, "talus_effect.name"),
          .present = effect.present != 0,
          .reason = optional_text(effect.reason),
          .key = optional_text(effect.key),
          .ledger_line = optional_text(effect.ledger_line),
          .may_hold = effect.may_hold != 0,
          .limit = optional_text(effect.limit)};
}

core::GroupDescription group_from(const talus_group* said) {
  const talus_group group = taken(said, "talus_group");
  if (group.corners < 1 || group.corners > 3)
    throw core::UsageError("talus_group.corners is " + std::to_string(group.corners) +
                           "; 1 (points), 2 (segments) or 3 (triangles) is expected");
  const auto nodes = values(group.cell_nodes, group.cells, static_cast<std::size_t>(group.corners),
                            "talus_group.cell_nodes");
  return {.name = text(group.name, "talus_group.name"),
          .kind = static_cast<core::CellKind>(group.corners),
          .nodes = group.nodes,
          .cells = {nodes.begin(), nodes.end()},
          .fields = {}};
}

core::FieldDescription field_from(const talus_field& said) {
  if (said.components < 1 || said.components > 9)
    throw core::UsageError("talus_field.components is " + std::to_string(said.components) +
                           "; 1 to 9 is expected");
  return {.name = text(said.name, "talus_field.name"),
          .unit = optional_text(said.unit),
          .components = static_cast<std::uint8_t>(said.components),
          .location = static_cast<core::FieldLocation>(said.location)};
}

core::TableDescription table_from(const talus_table* said) {
  const talus_table table = taken(said, "talus_table");
  core::TableDescription made{.name = text(table.name, "talus_table.name"),
                              .columns = texts(table.column_names, table.columns, "talus_table.column_names"),
                              .capacity = table.capacity,
                              .kind = static_cast<core::TableKind>(table.kind)};
  if (table.row_names != nullptr) made.rows = texts(table.row_names, table.capacity, "talus_table.row_names");
  return made;
}

core::Complaint complaint_from(const talus_complaint* said) {
  const talus_complaint complaint = taken(said, "talus_complaint");
  return {.file = optional_text(complaint.file),
          .line = complaint.line,
          .column = complaint.column,
          .key_path = optional_text(complaint.key_path),
          .message = text(complaint.message, "talus_complaint.message")};
}

core::NumericalError::Details numerical_error_from(const talus_numerical_details* said) {
  const talus_numerical_details error = taken(said, "talus_numerical_details");
  return {.what = text(error.what, "talus_numerical_details.what"),
          .entity = optional_text(error.entity),
          .step = error.step,
          .time = error.time,
          .value = error.value};
}

coupler::Declaration declaration_from(const talus_declaration* said, coupler::Declaration added) {
  const talus_declaration declaration = taken(said, "talus_declaration");
  added.program = text(declaration.program, "talus_declaration.program");
  added.step = declaration.step;
  added.insists_on_step = declaration.insists_on_step != 0;
  added.free_velocity = declaration.free_velocity != 0;
  added.light_boundary = declaration.light_boundary != 0;
  added.loses_cells = declaration.loses_cells != 0;
  added.checkpoints = declaration.checkpoints != 0;
  added.force_use = declaration.force_is_load != 0 ? coupler::ForceUse::load : coupler::ForceUse::kicks;
  return added;
}

}  // namespace talus::c_api
