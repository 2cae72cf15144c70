#include "coupler/run/sources.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace talus::coupler {
namespace {

using transport::ArrayName;

void copy(std::span<const double> from, std::span<double> to) {
  std::copy(from.begin(), from.end(), to.begin());
}

template <class Cells>
core::GroupDescription boundary_group(const char* name, core::CellKind kind, const mesh::Surface& surface,
                                      const Cells& cells) {
  core::GroupDescription group{.name = name,
                               .kind = kind,
                               .nodes = surface.node_count(),
                               .cells = {},
                               .fields = {{.name = "force", .unit = "N", .components = 3}}};
  for (const auto& cell : cells) group.cells.insert(group.cells.end(), cell.begin(), cell.end());
  return group;
}

}  // namespace

void PeerSource::fill_probes(std::span<double> values) const {
  copy(peer_.output_arrays().probes(block()), values);
}
void PeerSource::fill_ledger(std::span<double> joules) const {
  copy(peer_.output_arrays().ledger(block()), joules);
}
void PeerSource::fill_positions(std::size_t group, std::span<double> positions) const {
  copy(peer_.output_arrays().positions(block(), group), positions);
}
void PeerSource::fill_field(std::size_t group, std::size_t field, std::span<double> values) const {
  copy(peer_.output_arrays().field(block(), group, field), values);
}

std::int64_t PeerSource::table_rows(std::size_t table) const {
  const double rows = peer_.output_arrays().table_rows(block(), table);
  const core::TableDescription& description = this->description().tables[table];
  if (rows >= 0 && rows <= static_cast<double>(description.capacity)) return static_cast<std::int64_t>(rows);
  throw core::TransportError(
      {.peer = peer_.label(),
       .waited_for = "a report",
       .reason = "sent more rows of the table " + description.name + " than it declared"});
}
void PeerSource::fill_table(std::size_t table, std::int64_t first, std::span<double> values) const {
  const std::size_t columns = description().tables[table].columns.size();
  const auto rows = peer_.output_arrays().table(block(), table);
  copy(rows.subspan(static_cast<std::size_t>(first) * columns, values.size()), values);
}

InterfaceSource::InterfaceSource(const Interface& interface, const Peer& particles, const Exchange& exchange)
    : interface_(interface), particles_(particles), exchange_(exchange) {
  for (const char* axis : {"x", "y", "z"})
    description_.probes.push_back({"interface.force_" + std::string(axis) + "_N"});
  description_.ledger = {
      {"interface.work_on_structure_J", core::LedgerKind::memo},
      {"interface.work_on_boundary_J", core::LedgerKind::memo},
      // The sides count what each of them received; what their sum is short of was created here.
      {"interface.created_J", core::LedgerKind::stored}};
  const mesh::Surface& surface = interface.boundary;
  if (!surface.segments.empty()) {
    description_.groups.push_back(
        boundary_group("boundary", core::CellKind::segment, surface, surface.segments));
  }
  if (!surface.triangles.empty()) {  // dem_solver has `boundary_faces`, all that it touches
    description_.groups.push_back(
        boundary_group("interface_faces", core::CellKind::triangle, surface, surface.triangles));
  }
}

void InterfaceSource::fill_probes(std::span<double> values) const {
  std::fill(values.begin(), values.end(), 0.0);
  const auto force = particles_.array(ArrayName::force);
  for (std::size_t i = 0; i < force.size(); ++i) values[i % 3] += force[i];
}

void InterfaceSource::fill_ledger(std::span<double> joules) const {
  joules[0] = exchange_.work_on_structure();
  joules[1] = exchange_.work_on_boundary();
  joules[2] = joules[0] - joules[1];
}

void InterfaceSource::fill_positions(std::size_t, std::span<double> positions) const {
  const auto displacement = particles_.array(ArrayName::displacement);
  const auto& reference = interface_.boundary.positions;
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = reference[i] + displacement[i];
}

void InterfaceSource::fill_field(std::size_t, std::size_t, std::span<double> values) const {
  copy(particles_.array(ArrayName::force), values);
}

}  // namespace talus::coupler
