#include "coupler/messages/messages.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "coupler/messages/validate.hpp"

namespace talus::coupler {
namespace {

using nlohmann::json;

template <class T>
json binary(const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  return json::binary(std::vector<std::uint8_t>(bytes, bytes + values.size() * sizeof(T)));
}

template <class T>
std::vector<T> values_of(const json& message) {
  const auto& bytes = message.get_binary();
  if (bytes.size() % sizeof(T) != 0) throw std::length_error("an array ends within a value");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

Bytes cbor(const json& message) {
  const std::vector<std::uint8_t> bytes = json::to_cbor(message);
  const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
  return {begin, begin + bytes.size()};
}

json parse(ByteView bytes) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return json::from_cbor(begin, begin + bytes.size());
}

/// Runs a decoder; a message that does not hold what it should is the sender's fault, whatever exception says
/// so.
template <class Decode>
auto decoded(const char* what, const std::string& sender, Decode&& decode) {
  const auto refuse = [&](const char* why, const std::exception& error) {
    return core::TransportError(
        {.peer = sender, .waited_for = what, .reason = std::string(why) + " (" + error.what() + ")"});
  };
  try {
    return decode();
  } catch (const std::invalid_argument& error) {
    throw refuse("said what cannot be", error);
  } catch (const std::exception& error) {
    throw refuse("sent a message that cannot be read", error);
  }
}

json to_json(const mesh::SurfacePart& part) {
  return {{"name", part.name},
          {"material", part.material},
          {"wire_radius", part.wire_radius},
          {"segments", {part.segment_begin, part.segment_end}},
          {"triangles", {part.triangle_begin, part.triangle_end}}};
}

mesh::SurfacePart part_from(const json& j) {
  return {.name = j.at("name"),
          .material = j.at("material"),
          .wire_radius = j.at("wire_radius"),
          .segment_begin = j.at("segments").at(0),
          .segment_end = j.at("segments").at(1),
          .triangle_begin = j.at("triangles").at(0),
          .triangle_end = j.at("triangles").at(1)};
}

json to_json(const core::GroupDescription& group) {
  json fields = json::array();
  for (const auto& field : group.fields) {
    fields.push_back({{"name", field.name},
                      {"unit", field.unit},
                      {"components", field.components},
                      {"location", static_cast<int>(field.location)}});
  }
  return {{"name", group.name},
          {"kind", static_cast<int>(group.kind)},
          {"nodes", group.nodes},
          {"cells", binary(group.cells)},
          {"fields", fields}};
}

core::GroupDescription group_from(const json& j) {
  core::GroupDescription group{.name = j.at("name"),
                               .kind = static_cast<core::CellKind>(j.at("kind").get<int>()),
                               .nodes = j.at("nodes"),
                               .cells = values_of<std::int64_t>(j.at("cells")),
                               .fields = {}};
  for (const auto& field : j.at("fields")) {
    group.fields.push_back({.name = field.at("name"),
                            .unit = field.at("unit"),
                            .components = field.at("components"),
                            .location = static_cast<core::FieldLocation>(field.at("location").get<int>())});
  }
  return group;
}

json to_json(const core::OutputDescription& outputs) {
  json j{{"probes", json::array()},
         {"ledger", json::array()},
         {"groups", json::array()},
         {"tables", json::array()}};
  for (const auto& probe : outputs.probes)
    j["probes"].push_back({{"name", probe.name}, {"watches", probe.watches}});
  for (const auto& line : outputs.ledger)
    j["ledger"].push_back({{"name", line.name}, {"kind", static_cast<int>(line.kind)}});
  for (const auto& group : outputs.groups) j["groups"].push_back(to_json(group));
  for (const auto& table : outputs.tables)
    j["tables"].push_back({{"name", table.name},
                           {"columns", table.columns},
                           {"capacity", table.capacity},
                           {"kind", static_cast<int>(table.kind)},
                           {"rows", table.rows}});
  for (const auto& fact : outputs.facts) j["facts"].push_back({{"name", fact.name}, {"value", fact.value}});
  return j;
}

core::OutputDescription outputs_from(const json& j) {
  core::OutputDescription outputs;
  for (const auto& probe : j.at("probes"))
    outputs.probes.push_back({.name = probe.at("name"), .watches = probe.at("watches")});
  for (const auto& line : j.at("ledger")) {
    outputs.ledger.push_back(
        {.name = line.at("name"), .kind = static_cast<core::LedgerKind>(line.at("kind").get<int>())});
  }
  for (const auto& group : j.at("groups")) outputs.groups.push_back(group_from(group));
  for (const auto& table : j.at("tables"))
    outputs.tables.push_back({.name = table.at("name"),
                              .columns = table.at("columns"),
                              .capacity = table.at("capacity"),
                              .kind = static_cast<core::TableKind>(table.at("kind").get<int>()),
                              .rows = table.value("rows", std::vector<std::string>{})});
  for (const auto& fact : j.value("facts", json::array()))
    outputs.facts.push_back({.name = fact.at("name"), .value = fact.at("value")});
  return outputs;
}

json to_json(const core::Complaint& c) {
  return {{"file", c.file},
          {"line", c.line},
          {"column", c.column},
          {"key_path", c.key_path},
          {"message", c.message}};
}

json to_json(const core::NumericalError::Details& d) {
  json details{{"what", d.what},
               {"entity", d.entity},
               {"step", d.step},
               {"time", d.time},
               {"value", binary(std::vector<double>{d.value})}};
  if (d.last_output_time) details["last_output_time"] = *d.last_output_time;
  return details;
}

}  // namespace

Bytes encode(const PublishedSurface& published) {
  const mesh::Surface& surface = published.surface;
  json parts = json::array();
  for (const auto& part : surface.parts) parts.push_back(to_json(part));
  return cbor({{"positions", binary(surface.positions)},
               {"segments", binary(surface.segments)},
               {"triangles", binary(surface.triangles)},
               {"parts", parts},
               {"start", binary(surface.start)},
               {"node_masses", binary(published.node_masses)}});
}

PublishedSurface decode_surface(ByteView bytes, const std::string& sender) {
  return decoded("a surface", sender, [&] {
    const json j = parse(bytes);
    PublishedSurface published;
    published.surface.positions = values_of<double>(j.at("positions"));
    published.surface.segments = values_of<std::array<mesh::Index, 2>>(j.at("segments"));
    published.surface.triangles = values_of<std::array<mesh::Index, 3>>(j.at("triangles"));
    if (j.contains("start")) published.surface.start = values_of<double>(j.at("start"));
    for (const auto& part : j.at("parts")) published.surface.parts.push_back(part_from(part));
    published.node_masses = values_of<double>(j.at("node_masses"));
    validate(published);
    return published;
  });
}

Bytes encode(const Declaration& declaration) {
  json limits = json::array(), effects = json::array();
  for (const auto& limit : declaration.limits) {
    limits.push_back({{"name", limit.name},
                      {"seconds", limit.seconds},
                      {"stability", limit.stability},
                      {"reason", limit.reason}});
  }
  for (const auto& effect : declaration.effects) {
    effects.push_back({{"name", effect.name},
                       {"present", effect.present},
                       {"reason", effect.reason},
                       {"key", effect.key},
                       {"ledger_line", effect.ledger_line},
                       {"may_hold", effect.may_hold},
                       {"limit", effect.limit}});
  }
  return cbor({{"program", declaration.program},
               {"step", declaration.step},
               {"insists_on_step", declaration.insists_on_step},
               {"free_velocity", declaration.free_velocity},
               {"light_boundary", declaration.light_boundary},
               {"loses_cells", declaration.loses_cells},
               {"checkpoints", declaration.checkpoints},
               {"force_use", static_cast<int>(declaration.force_use)},
               {"limits", limits},
               {"effects", effects},
               {"outputs", to_json(declaration.outputs)},
               {"warnings", declaration.warnings}});
}

Declaration decode_declaration(ByteView bytes, const std::string& sender) {
  return decoded("a declaration", sender, [&] {
    const json j = parse(bytes);
    Declaration declaration{.program = j.at("program"),
                            .step = j.at("step"),
                            .insists_on_step = j.at("insists_on_step"),
                            .free_velocity = j.at("free_velocity"),
                            .light_boundary = j.at("light_boundary"),
                            .loses_cells = j.value("loses_cells", false),
                            .checkpoints = j.at("checkpoints"),
                            .force_use = static_cast<ForceUse>(j.at("force_use").get<std::uint32_t>()),
                            .limits = {},
                            .effects = {},
                            .outputs = outputs_from(j.at("outputs")),
                            .warnings = j.value("warnings", std::vector<std::string>{})};
    for (const auto& limit : j.at("limits")) {
      declaration.limits.push_back({.name = limit.at("name"),
                                    .seconds = limit.at("seconds"),
                                    .stability = limit.at("stability"),
                                    .reason = limit.at("reason")});
    }
    for (const auto& effect : j.at("effects")) {
      declaration.effects.push_back({.name = effect.at("name"),
                                     .present = effect.at("present"),
                                     .reason = effect.at("reason"),
                                     .key = effect.value("key", ""),
                                     .ledger_line = effect.value("ledger_line", ""),
                                     .may_hold = effect.value("may_hold", false),
                                     .limit = effect.value("limit", "")});
    }
    validate(declaration);
    return declaration;
  });
}

Bytes encode_failure(const std::exception& error) {
  json j{{"message", error.what()}};
  if (const auto* config = dynamic_cast<const core::ConfigError*>(&error)) {
    for (const auto& complaint : config->complaints()) j["complaints"].push_back(to_json(complaint));
  } else if (const auto* numerical = dynamic_cast<const core::NumericalError*>(&error)) {
    j["numerical"] = to_json(numerical->details());
  } else if (core::exit_code(error) == core::ExitCode::machine) {
    j["machine"] = true;
  }
  return cbor(j);
}

namespace {

std::vector<core::Complaint> complaints_from(const json& j) {
  std::vector<core::Complaint> complaints;
  for (const auto& c : j)
    complaints.push_back({c.at("file"), c.at("line"), c.at("column"), c.at("key_path"), c.at("message")});
  return complaints;
}

core::NumericalError::Details details_from(const json& d) {
  core::NumericalError::Details details{.what = d.at("what"),
                                        .entity = d.at("entity"),
                                        .step = d.at("step"),
                                        .time = d.at("time"),
                                        .value = values_of<double>(d.at("value")).at(0)};
  if (d.contains("last_output_time")) details.last_output_time = d.at("last_output_time");
  return details;
}

/// The participant's error, made again.
std::exception_ptr failure_from(const json& j, const FailureContext& context) {
  const std::string message = j.value("message", std::string("no reason given"));
  if (j.contains("complaints"))
    return std::make_exception_ptr(core::ConfigError(complaints_from(j["complaints"])));
  if (j.contains("numerical"))
    return std::make_exception_ptr(core::NumericalError(details_from(j["numerical"])));
  if (j.contains("machine"))
    return std::make_exception_ptr(core::MachineError(context.peer + ": " + message));
  return std::make_exception_ptr(core::TransportError({.peer = context.peer,
                                                       .waited_for = context.waited_for,
                                                       .window = context.window,
                                                       .reason = "gave up (" + message + ")"}));
}

}  // namespace

void throw_failure(ByteView bytes, const FailureContext& context) {
  std::rethrow_exception(
      decoded("a failure", context.peer, [&] { return failure_from(parse(bytes), context); }));
}

}  // namespace talus::coupler
