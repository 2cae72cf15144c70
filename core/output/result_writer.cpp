#include "core/output/result_writer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/errors.hpp"
#include "core/output/csv.hpp"
#include "core/output/field_index.hpp"
#include "core/output/field_store.hpp"
#include "core/output/file.hpp"
#include "core/output/last_words.hpp"
#include "core/output/peaks.hpp"
#include "core/output/reserve.hpp"
#include "core/output/result_tables.hpp"
#include "core/output/table.hpp"
#include "core/program/log.hpp"

namespace talus::core {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds summary_pause{2};  // between rewritings of the summary of a run in progress

const char* name_of(LedgerKind kind) {
  static constexpr std::array names{"stored", "dissipated", "supplied", "memo"};
  return names[static_cast<std::size_t>(kind)];
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

OutputDescription joined(const std::vector<const OutputSource*>& sources) {
  OutputDescription all;
  for (const auto* source : sources) {
    const auto& one = source->description();
    all.probes.insert(all.probes.end(), one.probes.begin(), one.probes.end());
    all.ledger.insert(all.ledger.end(), one.ledger.begin(), one.ledger.end());
    all.groups.insert(all.groups.end(), one.groups.begin(), one.groups.end());
    all.facts.insert(all.facts.end(), one.facts.begin(), one.facts.end());
  }
  std::set<std::string> names;
  for (const auto& group : all.groups)
    if (!names.insert(group.name).second)
      throw UsageError("two groups of field output are named '" + group.name + "'");
  return all;
}

template <class Description>
std::vector<std::string> columns(const std::vector<Description>& descriptions,
                                 const std::vector<std::string>& more = {}) {
  std::vector<std::string> names{"time_s"};
  for (const auto& description : descriptions) names.push_back(description.name);
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

/// Field files exist only where frames are asked for.
struct FieldFiles {
  FieldFiles(const std::filesystem::path& folder, const std::vector<GroupDescription>& groups,
             std::int64_t capacity)
      : store(folder / "fields.h5", groups, capacity), index(folder / "fields.xdmf", groups) {}
  FieldStore store;
  FieldIndex index;
};

/// The folder of a run, and room in it for the last words.
struct ResultPlace {
  explicit ResultPlace(const ResultWriter::Options& options)
      : folder(options.folder, options.existing), reserve(options.folder) {}
  ResultFolder folder;
  Reserve reserve;
};

}  // namespace

struct ResultWriter::Content {
  Options options;
  std::unique_ptr<ResultPlace> place;
  std::vector<const OutputSource*> sources;
  OutputDescription description;
  CsvFile probe_file;
  CsvFile energy_file;
  ResultTables tables;
  std::optional<FieldFiles> fields = {};
  LedgerBalance balance;
  EnergyGuard guard;
  Peaks peaks = {};
  nlohmann::json extra = nlohmann::json::object();

  std::string started_at = utc_now();
  Clock::time_point started = Clock::now();
  Clock::time_point summary_written = {};
  std::optional<double> first_time = {}, last_time = {};
  std::int64_t rows = 0;
  std::vector<double> probe_row = {}, energy_row = {}, field_values = {};

  Content(const Options& o, std::vector<const OutputSource*> s, std::unique_ptr<ResultPlace> p)
      : options(o),
        place(std::move(p)),
        sources(std::move(s)),
        description(joined(sources)),
        probe_file(o.folder / "probes.csv", columns(description.probes)),
        energy_file(o.folder / "energy.csv", columns(description.ledger, {"error_J", "error_relative"})),
        tables(o.folder, sources),
        balance(description.ledger),
        guard(o.energy_error, balance) {
    if (o.frame_capacity > 0) fields.emplace(o.folder, description.groups, o.frame_capacity);
    probe_row.resize(1 + description.probes.size());
    energy_row.resize(1 + description.ledger.size());
  }

  [[noreturn]] void fail(const std::string& what, double time, double value) const {
    throw NumericalError({.what = "a result is not finite",
                          .entity = what,
                          .step = -1,
                          .time = time,
                          .value = value,
                          .last_output_time = last_time.value_or(-1)});
  }
  void check_finite(std::span<const double> values, double time, const std::string& what) const {
    const auto bad =
        std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (bad != values.end()) fail(fmt::format("{}, value {}", what, bad - values.begin()), time, *bad);
  }
  template <class Description>
  void check_row(std::span<const double> row, double time,
                 const std::vector<Description>& descriptions) const {
    for (std::size_t i = 0; i < descriptions.size(); ++i)
      if (!std::isfinite(row[i + 1])) fail(descriptions[i].name, time, row[i + 1]);
  }

  void fill_rows(double time) {
    probe_row.front() = energy_row.front() = time;
    std::size_t probe = 1, line = 1;
    energy_row.resize(1 + description.ledger.size());
    for (const auto* source : sources) {
      const std::size_t probes = source->description().probes.size(),
                        lines = source->description().ledger.size();
      source->fill_probes(std::span(probe_row).subspan(probe, probes));
      source->fill_ledger(std::span(energy_row).subspan(line, lines));
      probe += probes;
      line += lines;
    }
  }

  /// The row that stands in probe_row and, without its balance, in energy_row.
  void append_row(double time) {
    peaks.add(time, std::span(probe_row).subspan(1));
    const auto row = balance.add(std::span(energy_row).subspan(1));
    energy_row.push_back(row.error);
    energy_row.push_back(row.error_relative);
    probe_file.write_row(probe_row);
    energy_file.write_row(energy_row);
    last_time = time;
    ++rows;
  }

  Table earlier_table(const std::filesystem::path& file, const std::vector<std::string>& names) const {
    Table table = read_table(file);
    if (table.names == names) return table;
    throw ConfigError(
        fmt::format("{} has other columns than this run writes; restart without it, or with the "
                    "probes of the earlier scene",
                    file.string()));
  }

  void write_group(const OutputSource& source, std::size_t local, std::size_t group, double time) {
    const auto& shape = description.groups[group];
    const auto nodes = static_cast<std::size_t>(shape.nodes),
               cells = static_cast<std::size_t>(shape.cell_count());
    field_values.resize(3 * nodes);
    source.fill_positions(local, field_values);
    check_finite(field_values, time, "position of " + shape.name);
    fields->store.write({group, -1}, field_values);
    for (std::size_t f = 0; f < shape.fields.size(); ++f) {
      const auto& field = shape.fields[f];
      field_values.resize((field.location == FieldLocation::node ? nodes : cells) * field.components);
      source.fill_field(local, f, field_values);
      check_finite(field_values, time, field.name + " of " + shape.name);
      fields->store.write({group, static_cast<std::int64_t>(f)}, field_values);
    }
  }

  nlohmann::json own_summary(RunStatus status, const std::string& message) const {
    const double wall = std::chrono::duration<double>(Clock::now() - started).count();
    const double simulated = last_time ? *last_time - *first_time : 0;
    nlohmann::json json = extra;
    json.update(facts_of(options, status, message));
    json["started_at"] = started_at;
    json["simulated_time_s"] = simulated;
    json["wall_time_s"] = wall;
    json["real_time_factor"] = wall > 0 ? simulated / wall : 0;
    json["rows"] = rows;
    json["frames"] = fields ? fields->store.frames_written() : 0;
    json["energy"]["error_J"] = balance.last().error;
    json["energy"]["error_relative"] = balance.last().error_relative;
    json["energy"]["largest_error_J"] = balance.largest().error;
    json["energy"]["largest_error_relative"] = balance.largest().error_relative;
    json["energy"]["impact_J"] = balance.scale();
    json["tables"] = tables.summary();
    json["warnings"] = warnings_said();
    for (const Fact& fact : description.facts) json["facts"][fact.name] = fact.value;
    add_columns(json);
    return json;
  }
  void add_columns(nlohmann::json& json) const {
    json["peaks"] = json["last"] = nlohmann::json::object();
    for (std::size_t i = 0; i < peaks.all().size(); ++i) {
      const auto& name = description.probes[i].name;
      json["peaks"][name] = {{"value", peaks.all()[i].value}, {"time_s", peaks.all()[i].time}};
      json["last"][name] = probe_row[i + 1];
      const auto& watches = description.probes[i].watches;
      if (!watches.empty()) json["probes"][name.substr(0, name.find('.'))] = watches;
    }
    for (const auto& line : description.ledger) json["energy"]["kinds"][line.name] = name_of(line.kind);
    for (std::size_t i = 0; rows > 0 && i < description.ledger.size(); ++i)
      json["energy"]["last"][description.ledger[i].name] = energy_row[i + 1];
  }
  void write_summary(RunStatus status, const std::string& message, Durability durability = Durability::kill) {
    replace_file(options.folder / "summary.json", text_of(own_summary(status, message)), durability);
    summary_written = Clock::now();
  }
  /// Some file systems say only here that there was no room.
  void close_files() {
    probe_file.close();
    energy_file.close();
    tables.close();
    if (fields) fields->store.close();
  }
};

ResultWriter::ResultWriter(const Options& options, std::vector<const OutputSource*> sources) {
  auto place = std::make_unique<ResultPlace>(options);
  try {
    content_ = std::make_unique<Content>(options, std::move(sources), std::move(place));
    content_->write_summary(RunStatus::running, {});
  } catch (const MachineError& error) {
    content_.reset();
    write_failed_summary(options, error.what());
    throw;
  }
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::write_row(double time) {
  auto& c = *content_;
  if (c.last_time && time <= *c.last_time)
    throw UsageError("rows of a result must be written in the order of time");
  c.fill_rows(time);
  c.check_row(c.probe_row, time, c.description.probes);
  c.check_row(c.energy_row, time, c.description.ledger);
  c.append_row(time);
  c.tables.update(time);
  if (!c.first_time) c.first_time = time;
  for (const std::string& warning : c.guard.look(time)) log_warning(warning);
  if (Clock::now() - c.summary_written > summary_pause) c.write_summary(RunStatus::running, {});
}

std::int64_t ResultWriter::take_over(const std::filesystem::path& earlier, double before) {
  auto& c = *content_;
  const Table probes = c.earlier_table(earlier / "probes.csv", columns(c.description.probes));
  const Table energy =
      c.earlier_table(earlier / "energy.csv", columns(c.description.ledger, {"error_J", "error_relative"}));
  const auto row_of = [](const Table& table, std::size_t row, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = table.columns[i][row];
  };
  const std::size_t rows = std::min(probes.rows(), energy.rows());
  for (std::size_t row = 0; row < rows && probes.columns[0][row] < before; ++row) {
    c.energy_row.resize(1 + c.description.ledger.size());
    row_of(probes, row, c.probe_row);
    row_of(energy, row, c.energy_row);
    c.append_row(c.probe_row.front());
  }
  return c.rows;
}

void ResultWriter::write_fields(double time) {
  auto& c = *content_;
  if (!c.fields) throw UsageError("field output was not asked for");
  std::size_t group = 0;
  for (const auto* source : c.sources)
    for (std::size_t local = 0; local < source->description().groups.size(); ++local)
      c.write_group(*source, local, group++, time);
  c.fields->store.end_frame(time);
  c.fields->index.add_frame(time);
}

const std::filesystem::path& ResultWriter::folder() const {
  return content_->place->folder.path();
}
std::optional<double> ResultWriter::last_row_time() const {
  return content_->last_time;
}
const LedgerBalance& ResultWriter::balance() const {
  return content_->balance;
}
nlohmann::json& ResultWriter::summary() {
  return content_->extra;
}

void ResultWriter::finish(RunStatus status, const std::string& message) {
  auto& c = *content_;
  if (status == RunStatus::finished) c.guard.judge(c.last_time.value_or(0));
  c.close_files();
  if (c.fields) c.fields->index.write();
  c.place->reserve.release();
  c.write_summary(status, message, Durability::power_loss);
}

void ResultWriter::give_up(const std::string& message) noexcept {
  auto& c = *content_;
  c.place->reserve.release();
  write_if_possible([&] { c.write_summary(RunStatus::failed, message, Durability::power_loss); });
  if (c.fields) write_if_possible([&] { c.fields->index.write(); });
}

}  // namespace talus::core
