#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// What a solver offers for output, in a form that can be written by the solver itself (standalone) or by the
/// coupler process (coupled, through shared memory). Descriptions are fixed before time 0; values are pulled
/// at output times only.
namespace talus::core {

enum class FieldLocation : std::uint8_t { node, cell };
enum class CellKind : std::uint8_t {
  vertex = 1,
  segment = 2,
  triangle = 3
};  ///< the value is the number of nodes of a cell

struct FieldDescription {
  std::string name;  ///< "displacement"
  std::string unit;  ///< "m"
  std::uint8_t components = 1;
  FieldLocation location = FieldLocation::node;
};

/// A set of cells of one kind that is drawn together: `net`, `membrane`, `boundary`, `rocks`. Its node
/// positions are written every frame as the field "position", which each group has without naming it.
struct GroupDescription {
  std::string name;
  CellKind kind = CellKind::vertex;
  std::int64_t nodes = 0;
  std::vector<std::int64_t> cells;  ///< node indices, `kind` of them a cell
  std::vector<FieldDescription> fields;
  std::int64_t cell_count() const { return static_cast<std::int64_t>(cells.size()) / static_cast<int>(kind); }
};

/// A column of probes.csv.
struct ProbeDescription {
  std::string name;          ///< "net_centre.displacement_z_m": probe, quantity, SI unit
  std::string watches = {};  ///< what stands for the probe's point: "node 220 of net at ...", for the summary
};

/// How a ledger line enters the balance  stored + dissipated - supplied = constant. A memo is only shown.
enum class LedgerKind : std::uint8_t { stored, dissipated, supplied, memo };
struct LedgerDescription {
  std::string name;  ///< "structure.kinetic_J": side, line, unit
  LedgerKind kind = LedgerKind::stored;
};

/// What becomes of a table: events only become more and are written to <name>.csv; a distribution has rows
/// whose values change, and stands in the summary.
enum class TableKind : std::uint8_t { events, distribution };
struct TableDescription {
  std::string name;                  ///< "below"
  std::vector<std::string> columns;  ///< "time_s", "diameter_m"
  std::int64_t capacity = 0;         ///< most rows it will ever have
  TableKind kind = TableKind::events;
  std::vector<std::string> rows = {};  ///< names of the rows of a distribution; empty: they are numbered
};

/// A number that is known before time 0, for the summary.
struct Fact {
  std::string name;  ///< "particles.rocks.block.filling_deviation_m"
  double value = 0;
};

struct OutputDescription {
  std::vector<ProbeDescription> probes;
  std::vector<LedgerDescription> ledger;
  std::vector<GroupDescription> groups;
  std::vector<TableDescription> tables = {};
  std::vector<Fact> facts = {};
};

/// A solver as the writer of results sees it. Calls are made between steps, at equal times for all values.
class OutputSource {
 public:
  virtual ~OutputSource() = default;
  virtual const OutputDescription& description() const = 0;
  virtual void fill_probes(std::span<double> values) const = 0;  ///< one a probe column
  virtual void fill_ledger(std::span<double> joules) const = 0;  ///< one a ledger line
  /// The current node positions of a group, 3 a node (m).
  virtual void fill_positions(std::size_t group, std::span<double> positions) const = 0;
  /// A field of a group, components of each node or cell in turn.
  virtual void fill_field(std::size_t group, std::size_t field, std::span<double> values) const = 0;
  /// The rows that a table has now; of events never less than before.
  virtual std::int64_t table_rows(std::size_t) const { return 0; }
  /// Its rows from `first` on, the columns of each in turn.
  virtual void fill_table(std::size_t /*table*/, std::int64_t /*first*/, std::span<double>) const {}
};

}  // namespace talus::core
