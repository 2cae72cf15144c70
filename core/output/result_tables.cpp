#include "core/output/result_tables.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/errors.hpp"
#include "core/output/csv.hpp"
#include "core/output/result_folder.hpp"

namespace talus::core {
namespace {

/// One table of one source, as it was asked last.
struct SourceTable {
  const OutputSource* source;
  std::size_t number;  ///< among the source's tables
  std::optional<CsvFile> file = {};
  std::int64_t rows = 0;
  std::vector<double> values = {};  ///< of the rows that were asked for last

  const TableDescription& description() const { return source->description().tables[number]; }
  std::span<const double> row(std::size_t index) const {
    const std::size_t columns = description().columns.size();
    return std::span(values).subspan(index * columns, columns);
  }

  /// Asks for the rows from `first` on.
  void ask(std::int64_t first, double time) {
    rows = source->table_rows(number);
    if (rows < first) throw UsageError("events of the table " + description().name + " are gone");
    values.resize(static_cast<std::size_t>(rows - first) * description().columns.size());
    source->fill_table(number, first, values);
    const auto bad = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
    if (bad != values.end())
      throw NumericalError({.what = "a result is not finite",
                            .entity = "the table " + description().name,
                            .time = time,
                            .value = *bad});
  }
};

}  // namespace

struct ResultTables::Content {
  std::vector<SourceTable> tables;
};

ResultTables::ResultTables(std::filesystem::path folder, const std::vector<const OutputSource*>& sources)
    : content_(std::make_unique<Content>()) {
  const auto& fixed = ResultFolder::file_names();
  std::set<std::string> taken(fixed.begin(), fixed.end());
  for (const auto* source : sources)
    for (std::size_t number = 0; number < source->description().tables.size(); ++number) {
      SourceTable& table = content_->tables.emplace_back(SourceTable{source, number});
      const std::string file = ResultFolder::table_file(table.description().name);
      if (!taken.insert(file).second) throw UsageError("two tables of a result are named '" + file + "'");
      if (table.description().kind == TableKind::events)
        table.file.emplace(folder / file, table.description().columns);
    }
}

ResultTables::~ResultTables() = default;

void ResultTables::update(double time) {
  for (SourceTable& table : content_->tables) {
    const std::int64_t written = table.file ? table.rows : 0;
    table.ask(written, time);
    if (!table.file) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.rows - written); ++k)
      table.file->write_row(table.row(k));
  }
}

void ResultTables::close() {
  for (SourceTable& table : content_->tables)
    if (table.file) table.file->close();
}

nlohmann::json ResultTables::summary() const {
  auto json = nlohmann::json::object();
  for (const SourceTable& table : content_->tables) {
    const TableDescription& description = table.description();
    auto& entry = json[description.name];
    if (table.file) {
      entry = {{"file", ResultFolder::table_file(description.name)}, {"rows", table.rows}};
      continue;
    }
    const bool named = !description.rows.empty();
    entry = named ? nlohmann::json::object() : nlohmann::json::array();
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.rows); ++k) {
      auto& object = named ? entry[description.rows[k]] : entry.emplace_back(nlohmann::json::object());
      for (std::size_t c = 0; c < description.columns.size(); ++c)
        object[description.columns[c]] = table.row(k)[c];
    }
  }
  return json;
}

}  // namespace talus::core
