#include "python/participant/native/conversions.hpp"

#include <pybind11/stl.h>

#include <string>

#include "core/errors.hpp"

namespace talus::python {
namespace {

/// The array's rows, after checking that each holds `columns` values.
template <std::size_t columns, class Array>
auto rows(const Array& array, const char* name) {
  using Value = typename Array::value_type;
  if (array.size() != 0 && (array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(columns))) {
    throw core::UsageError(std::string(name) + " expects an array of shape (n, " + std::to_string(columns) +
                           ")");
  }
  std::vector<std::array<Value, columns>> values(static_cast<std::size_t>(array.size()) / columns);
  std::copy_n(array.data(), array.size(), values.empty() ? nullptr : values.front().data());
  return values;
}

/// The three values of each row, one after the other.
std::vector<double> vectors(const py::object& array, const char* name) {
  std::vector<double> values;
  for (const auto& row : rows<3>(array.cast<DoubleArray>(), name))
    values.insert(values.end(), row.begin(), row.end());
  return values;
}

template <class Described>
std::vector<Described> each(const py::handle& items, Described (*describe)(const py::handle&)) {
  std::vector<Described> described;
  for (const py::handle item : items) described.push_back(describe(item));
  return described;
}

coupler::StepLimit limit_from(const py::handle& limit) {
  return {.name = limit.attr("name").cast<std::string>(),
          .seconds = limit.attr("seconds").cast<double>(),
          .stability = limit.attr("stability").cast<bool>(),
          .reason = limit.attr("reason").cast<std::string>()};
}

coupler::Effect effect_from(const py::handle& effect) {
  return {.name = effect.attr("name").cast<std::string>(),
          .present = effect.attr("present").cast<bool>(),
          .reason = effect.attr("reason").cast<std::string>(),
          .key = effect.attr("key").cast<std::string>(),
          .ledger_line = effect.attr("ledger_line").cast<std::string>(),
          .may_hold = effect.attr("may_hold").cast<bool>(),
          .limit = effect.attr("limit").cast<std::string>()};
}

core::ProbeDescription probe_from(const py::handle& probe) {
  if (py::isinstance<py::str>(probe)) return {.name = probe.cast<std::string>()};
  return {.name = probe.attr("name").cast<std::string>(),
          .watches = probe.attr("watches").cast<std::string>()};
}

core::LedgerDescription ledger_line_from(const py::handle& line) {
  return {.name = line.attr("name").cast<std::string>(), .kind = line.attr("kind").cast<core::LedgerKind>()};
}

core::FieldDescription field_from(const py::handle& field) {
  return {.name = field.attr("name").cast<std::string>(),
          .unit = field.attr("unit").cast<std::string>(),
          .components = field.attr("components").cast<std::uint8_t>(),
          .location = field.attr("location").cast<core::FieldLocation>()};
}

core::GroupDescription group_from(const py::handle& group) {
  const auto cells =
      group.attr("cells").cast<py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>>();
  if (cells.ndim() != 2 || cells.shape(1) < 1 || cells.shape(1) > 3) {
    throw core::UsageError("cells of a group expects an array of shape (n, 1), (n, 2) or (n, 3)");
  }
  return {.name = group.attr("name").cast<std::string>(),
          .kind = static_cast<core::CellKind>(cells.shape(1)),
          .nodes = group.attr("nodes").cast<std::int64_t>(),
          .cells = {cells.data(), cells.data() + cells.size()},
          .fields = each(group.attr("fields"), field_from)};
}

core::TableDescription table_from(const py::handle& table) {
  return {.name = table.attr("name").cast<std::string>(),
          .columns = table.attr("columns").cast<std::vector<std::string>>(),
          .capacity = table.attr("capacity").cast<std::int64_t>(),
          .kind = table.attr("kind").cast<core::TableKind>(),
          .rows = table.attr("rows").cast<std::vector<std::string>>()};
}

std::vector<core::Fact> facts_from(const py::handle& facts) {
  std::vector<core::Fact> made;
  for (const auto& [name, value] : py::dict(py::reinterpret_borrow<py::object>(facts)))
    made.push_back({.name = name.cast<std::string>(), .value = value.cast<double>()});
  return made;
}

mesh::SurfacePart part_from(const py::handle& part) {
  const auto segments = part.attr("segments").cast<std::pair<mesh::Index, mesh::Index>>();
  const auto triangles = part.attr("triangles").cast<std::pair<mesh::Index, mesh::Index>>();
  return {.name = part.attr("name").cast<std::string>(),
          .material = part.attr("material").cast<std::string>(),
          .wire_radius = part.attr("wire_radius").cast<double>(),
          .segment_begin = segments.first,
          .segment_end = segments.second,
          .triangle_begin = triangles.first,
          .triangle_end = triangles.second};
}

template <class Value>
py::array view_of(std::span<Value> values, std::size_t columns, const py::object& owner) {
  const auto count = static_cast<py::ssize_t>(values.size());
  const auto width = static_cast<py::ssize_t>(columns);
  std::vector<py::ssize_t> shape{count};
  if (columns > 0) shape = {count / width, width};
  return py::array_t<double>(shape, values.data(), owner);
}

template <class Row>
py::array_t<typename Row::value_type> array_of(const std::vector<Row>& values) {
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size()),
                                       static_cast<py::ssize_t>(std::tuple_size_v<Row>)};
  return py::array_t<typename Row::value_type>(shape, values.empty() ? nullptr : values.front().data());
}

}  // namespace

mesh::Surface surface_from(const py::object& surface) {
  mesh::Surface made{.positions = vectors(surface.attr("positions"), "positions")};
  made.segments = rows<2>(surface.attr("segments").cast<IndexArray>(), "segments");
  made.triangles = rows<3>(surface.attr("triangles").cast<IndexArray>(), "triangles");
  if (const py::object start = surface.attr("start"); !start.is_none()) made.start = vectors(start, "start");
  made.parts = each(surface.attr("parts"), part_from);
  if (!made.parts.empty()) return made;
  made.parts = {{.name = surface.attr("name").cast<std::string>(),
                 .segment_end = static_cast<mesh::Index>(made.segments.size()),
                 .triangle_end = static_cast<mesh::Index>(made.triangles.size())}};
  return made;
}

py::dict surface_arrays(const mesh::Surface& surface) {
  using namespace py::literals;
  const auto nodes = static_cast<py::ssize_t>(surface.node_count());
  py::object start = py::none();
  if (!surface.start.empty()) start = py::array_t<double>({nodes, py::ssize_t{3}}, surface.start.data());
  return py::dict("positions"_a = py::array_t<double>({nodes, py::ssize_t{3}}, surface.positions.data()),
                  "segments"_a = array_of(surface.segments), "triangles"_a = array_of(surface.triangles),
                  "start"_a = start);
}

py::list surface_parts(const mesh::Surface& surface) {
  using namespace py::literals;
  py::list parts;
  for (const auto& part : surface.parts)
    parts.append(py::dict("name"_a = part.name, "material"_a = part.material,
                          "wire_radius"_a = part.wire_radius,
                          "segments"_a = std::pair(part.segment_begin, part.segment_end),
                          "triangles"_a = std::pair(part.triangle_begin, part.triangle_end)));
  return parts;
}

coupler::Declaration declaration_from(const py::object& declaration) {
  return {.program = declaration.attr("program").cast<std::string>(),
          .step = declaration.attr("step").cast<double>(),
          .insists_on_step = declaration.attr("insists_on_step").cast<bool>(),
          .free_velocity = declaration.attr("free_velocity").cast<bool>(),
          .light_boundary = declaration.attr("light_boundary").cast<bool>(),
          .loses_cells = declaration.attr("loses_cells").cast<bool>(),
          .checkpoints = declaration.attr("checkpoints").cast<bool>(),
          .force_use = declaration.attr("force_is_load").cast<bool>() ? coupler::ForceUse::load
                                                                      : coupler::ForceUse::kicks,
          .limits = each(declaration.attr("limits"), limit_from),
          .effects = each(declaration.attr("effects"), effect_from),
          .outputs = {.probes = each(declaration.attr("probes"), probe_from),
                      .ledger = each(declaration.attr("ledger"), ledger_line_from),
                      .groups = each(declaration.attr("groups"), group_from),
                      .tables = each(declaration.attr("tables"), table_from),
                      .facts = facts_from(declaration.attr("facts"))},
          .warnings = declaration.attr("warnings").cast<std::vector<std::string>>()};
}

py::array view(std::span<double> values, std::size_t columns, const py::object& owner) {
  return view_of(values, columns, owner);
}

py::array view(std::span<const double> values, std::size_t columns, const py::object& owner) {
  py::array array = view_of(values, columns, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace talus::python
