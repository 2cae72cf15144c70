#include "coupler/messages/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "interface_mesh/surface_checks.hpp"

namespace talus::coupler {
namespace {

template <class... Args>
void require(bool holds, fmt::format_string<Args...> otherwise, Args&&... args) {
  if (!holds) throw std::invalid_argument(fmt::format(otherwise, std::forward<Args>(args)...));
}

/// Names become columns, datasets and files.
void require_name(const std::string& name, const char* of) {
  constexpr std::size_t longest = 200;
  const bool plain = std::ranges::none_of(name, [](unsigned char c) {
    return c < 0x20 || c == 0x7f || c == '/' || c == '\\' || c == '"' || c == ',';
  });
  require(!name.empty() && name.size() <= longest && plain && name.front() != '.',
          "the name of {} is '{}'; it may have 1 to {} characters, none of / \\ \" , or control characters, "
          "and may "
          "not begin with a dot",
          of, name.substr(0, longest), longest);
}

template <class Kind>
void require_kind(Kind kind, Kind first, Kind last, const char* of, const std::string& name) {
  require(kind >= first && kind <= last, "{} '{}' has the unknown kind {}", of, name, static_cast<int>(kind));
}

/// Sizes that are multiplied with each other must not wrap.
constexpr std::int64_t most_values = std::int64_t{1} << 40;

template <std::size_t N>
void require_cells(const std::vector<std::array<mesh::Index, N>>& cells, mesh::Index nodes,
                   const char* what) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for (const mesh::Index node : cells[k])
      require(node >= 0 && node < nodes,
              "{} {} has the node {}, but the surface has the nodes 0 to {} (counted from 0)", what, k, node,
              nodes - 1);
    const std::set<mesh::Index> corners(cells[k].begin(), cells[k].end());
    require(corners.size() == N, "{} {} has the node {} twice", what, k, cells[k][0]);
  }
}

void require_range(mesh::Index begin, mesh::Index end, std::size_t count, const char* what,
                   const std::string& part) {
  require(begin >= 0 && begin <= end && static_cast<std::size_t>(end) <= count,
          "part '{}' has the {} {} to {}, but there are {}", part, what, begin, end, count);
}

void require_finite(std::span<const double> values, const char* what) {
  const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
  if (bad == values.end()) return;
  const auto place = bad - values.begin();
  throw std::invalid_argument(fmt::format("the {} of node {} is {}", what, place / 3, *bad));
}

void validate_group(const core::GroupDescription& group) {
  require_name(group.name, "a group of field output");
  require_kind(group.kind, core::CellKind::vertex, core::CellKind::triangle, "group", group.name);
  require(group.nodes >= 0 && group.nodes < most_values / 32, "group '{}' has {} nodes", group.name,
          group.nodes);
  const auto corners = static_cast<std::size_t>(group.kind);
  require(group.cells.size() % corners == 0, "group '{}' has {} node numbers for cells of {} nodes",
          group.name, group.cells.size(), corners);
  for (const std::int64_t node : group.cells)
    require(node >= 0 && node < group.nodes, "a cell of group '{}' has the node {}, but there are {}",
            group.name, node, group.nodes);
  for (const auto& field : group.fields) {
    require_name(field.name, "a field");
    require(field.components >= 1 && field.components <= 9,
            "field '{}' of group '{}' has {} components; 1 to 9 can be", field.name, group.name,
            static_cast<int>(field.components));
    require_kind(field.location, core::FieldLocation::node, core::FieldLocation::cell, "field", field.name);
  }
}

void validate_table(const core::TableDescription& table) {
  require_name(table.name, "a table");
  require_kind(table.kind, core::TableKind::events, core::TableKind::distribution, "table", table.name);
  require(!table.columns.empty(), "table '{}' has no columns", table.name);
  for (const auto& column : table.columns) require_name(column, "a table's column");
  const auto columns = static_cast<std::int64_t>(table.columns.size());
  require(table.rows.empty() || std::ssize(table.rows) == table.capacity,
          "table '{}' names {} rows and has room for {}", table.name, table.rows.size(), table.capacity);
  require(table.capacity >= 0 && table.capacity < most_values / columns, "table '{}' is to hold {} rows",
          table.name, table.capacity);
}

void validate_outputs(const core::OutputDescription& outputs) {
  std::set<std::string> columns, groups;
  const auto require_new = [](std::set<std::string>& names, const std::string& name) {
    require(name != "time_s", "the name 'time_s' is that of the table's own first column");
    require(names.insert(name).second, "the name '{}' is given twice", name);
  };
  for (const auto& probe : outputs.probes) {
    require_name(probe.name, "a probe");
    require_new(columns, probe.name);
  }
  for (const auto& line : outputs.ledger) {
    require_name(line.name, "a line of the ledger");
    require_kind(line.kind, core::LedgerKind::stored, core::LedgerKind::memo, "ledger line", line.name);
    require_new(columns, line.name);
  }
  for (const auto& group : outputs.groups) {
    validate_group(group);
    require_new(groups, group.name);
  }
  for (const auto& table : outputs.tables) validate_table(table);
  for (const auto& fact : outputs.facts)
    require(std::isfinite(fact.value), "the fact '{}' is {}", fact.name, fact.value);
}

}  // namespace

void validate(const PublishedSurface& published) {
  const mesh::Surface& surface = published.surface;
  require(surface.positions.size() % 3 == 0 && surface.positions.size() / 3 < (std::size_t{1} << 30),
          "the surface has {} coordinates; three a node are expected", surface.positions.size());
  require_finite(surface.positions, "position");
  require(surface.start.empty() || surface.start.size() == surface.positions.size(),
          "the surface has {} values of its displacement at time 0 for {} coordinates", surface.start.size(),
          surface.positions.size());
  require_finite(surface.start, "displacement at time 0");
  const mesh::Index nodes = surface.node_count();
  require_cells(surface.segments, nodes, "segment");
  require_cells(surface.triangles, nodes, "triangle");
  const auto flat = mesh::flat_cells(surface);
  require(flat.empty(), "{}", flat.empty() ? "" : flat.front());
  for (const auto& part : surface.parts) {
    require_range(part.segment_begin, part.segment_end, surface.segments.size(), "segments", part.name);
    require_range(part.triangle_begin, part.triangle_end, surface.triangles.size(), "triangles", part.name);
    require(part.wire_radius >= 0 && std::isfinite(part.wire_radius), "part '{}' has the wire radius {} m",
            part.name, part.wire_radius);
  }
  require(published.node_masses.size() == static_cast<std::size_t>(nodes),
          "there are {} node masses for {} nodes", published.node_masses.size(), nodes);
  for (std::size_t node = 0; node < published.node_masses.size(); ++node)
    require(published.node_masses[node] >= 0,  // infinite: held
            "node {} has the mass {} kg; 0, a positive number, or infinity for a held node is expected", node,
            published.node_masses[node]);
}

void validate(const Declaration& declaration) {
  require(declaration.step >= 0 && std::isfinite(declaration.step),
          "the step is {} s; a positive number, or 0 for one step a window, is expected", declaration.step);
  require(declaration.force_use == ForceUse::kicks || declaration.force_use == ForceUse::load,
          "the use of forces has the unknown number {}", static_cast<unsigned>(declaration.force_use));
  for (const auto& limit : declaration.limits)
    require(limit.seconds > 0, "the step limit '{}' is {} s; a positive number is expected", limit.name,
            limit.seconds);
  validate_outputs(declaration.outputs);
}

}  // namespace talus::coupler
