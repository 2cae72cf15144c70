#include "coupler/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "core/errors.hpp"
#include "core/output/field_reader.hpp"
#include "core/output/file.hpp"
#include "core/output/table.hpp"
#include "coupler/page/page.hpp"

namespace talus::report {

extern const char* const report_page_template;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_points = 800;    // of a curve
constexpr std::int64_t most_cells = 12000;  // of a drawing
constexpr std::int64_t instants = 5;

/// Five significant digits are more than a screen shows and keep the page small.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double scale = std::pow(10, 4 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

json rounded(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

/// The rows that are drawn, so that no extreme is lost: of each of so many stretches the rows of the least and the
/// largest value of every column, and the first and the last row of all.
std::vector<std::size_t> drawn_rows(std::span<const std::vector<double>> columns, std::size_t stretches) {
  const std::size_t rows = columns.front().size();
  std::set<std::size_t> drawn;
  if (rows > 0) drawn = {0, rows - 1};
  const std::size_t length = rows / stretches + 1;
  for (std::size_t begin = 0; begin < rows; begin += length) {
    const auto first = static_cast<std::ptrdiff_t>(begin),
               last = static_cast<std::ptrdiff_t>(std::min(begin + length, rows));
    for (const auto& column : columns) {
      const auto [least, most] = std::minmax_element(column.begin() + first, column.begin() + last);
      drawn.insert({static_cast<std::size_t>(least - column.begin()),
                    static_cast<std::size_t>(most - column.begin())});
    }
  }
  return {drawn.begin(), drawn.end()};
}

json picked_rows(const std::vector<double>& column, const std::vector<std::size_t>& rows) {
  std::vector<double> drawn;
  for (const auto row : rows) drawn.push_back(column[row]);
  return rounded(drawn);
}

/// Every curve with rows of its own.
json curves(const fs::path& file) {
  const core::Table table = core::read_table(file);
  json result{{"names", json::array()}, {"curves", json::array()}};
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    const auto rows = drawn_rows(std::span(table.columns).subspan(i, 1), most_points / 2);
    result["names"].push_back(table.names[i]);
    result["curves"].push_back({{"times", picked_rows(table.columns.front(), rows)},
                                {"values", picked_rows(table.columns[i], rows)}});
  }
  return result;
}

/// Curves that are drawn on top of each other have their rows in common, the extremes of all among them.
json stacked(const fs::path& file) {
  const core::Table table = core::read_table(file);
  const auto rows = drawn_rows(table.columns, most_points / 8);
  json result{{"names", table.names}, {"columns", json::array()}};
  for (const auto& column : table.columns) result["columns"].push_back(picked_rows(column, rows));
  return result;
}

/// m; the largest displacement of any node.
double largest_displacement(const core::FieldReader& fields, std::int64_t frame) {
  double largest = 0;
  for (const auto& group : fields.groups()) {
    if (std::ranges::find(group.fields, "displacement", &core::FieldDescription::name) == group.fields.end())
      continue;
    const auto values = fields.read(group, "displacement", frame);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      largest = std::max(largest, std::hypot(values[i], values[i + 1], values[i + 2]));
  }
  return largest;
}

/// The frame in which the structure is displaced most; the first where nothing is.
std::int64_t peak_frame(const core::FieldReader& fields) {
  std::int64_t peak = 0;
  double most = 0;
  for (std::int64_t frame = 0; frame < fields.frames(); ++frame)
    if (const double displacement = largest_displacement(fields, frame); displacement > most)
      most = displacement, peak = frame;
  return peak;
}

/// Evenly spaced, the first and the last among them, and the peak.
std::vector<std::int64_t> drawn_frames(const core::FieldReader& fields, std::int64_t peak) {
  std::set<std::int64_t> drawn;
  if (fields.frames() > 0) drawn.insert(peak);
  for (std::int64_t i = 0; i < instants && fields.frames() > 0; ++i)
    drawn.insert(i * (fields.frames() - 1) / (instants - 1));
  return {drawn.begin(), drawn.end()};
}

/// The cells that are drawn, with their nodes counted anew, so that only the nodes they need go onto the
/// page.
struct Drawing {
  std::vector<std::int64_t> nodes;  ///< of the group
  std::vector<std::int64_t> cells;  ///< indices into `nodes`
  std::int64_t stride = 1;          ///< every stride-th cell
};

Drawing drawing_of(const core::GroupDescription& group) {
  Drawing drawing;
  drawing.stride = group.cell_count() / most_cells + 1;
  std::vector<std::int64_t> place(static_cast<std::size_t>(group.nodes), -1);
  const auto width = static_cast<std::int64_t>(group.kind);
  for (std::int64_t cell = 0; cell < group.cell_count(); cell += drawing.stride) {
    for (std::int64_t k = 0; k < width; ++k) {
      const auto node = group.cells[static_cast<std::size_t>(cell * width + k)];
      auto& known = place[static_cast<std::size_t>(node)];
      if (known < 0) {
        known = static_cast<std::int64_t>(drawing.nodes.size());
        drawing.nodes.push_back(node);
      }
      drawing.cells.push_back(known);
    }
  }
  return drawing;
}

std::vector<double> picked(const std::vector<double>& values, const Drawing& drawing,
                           std::size_t components) {
  std::vector<double> result;
  for (const auto node : drawing.nodes)
    for (std::size_t k = 0; k < components; ++k)
      result.push_back(values[static_cast<std::size_t>(node) * components + k]);
  return result;
}

/// Positions at the instants, and the radius where the group has one, so that rocks are drawn in their size.
json drawn_group(const core::FieldReader& fields, const core::GroupDescription& group,
                 const std::vector<std::int64_t>& frames) {
  const Drawing drawing = drawing_of(group);
  json result{{"name", group.name},
              {"kind", static_cast<int>(group.kind)},
              {"cells", drawing.cells},
              {"stride", drawing.stride},
              {"positions", json::array()}};
  for (const auto frame : frames)
    result["positions"].push_back(rounded(picked(fields.read(group, "position", frame), drawing, 3)));
  for (const auto& field : group.fields)
    if (field.name == "radius" && field.location == core::FieldLocation::node)
      result["radius"] = rounded(picked(fields.read(group, field.name, frames.front()), drawing, 1));
  return result;
}

json views(const fs::path& file) {
  json result{{"times", json::array()}, {"groups", json::array()}};
  if (!fs::exists(file)) return result;
  const core::FieldReader fields(file);
  const std::int64_t peak = peak_frame(fields);
  const auto frames = drawn_frames(fields, peak);
  if (frames.empty()) return result;
  result["peak_time"] = fields.times()[static_cast<std::size_t>(peak)];
  for (const auto frame : frames) result["times"].push_back(fields.times()[static_cast<std::size_t>(frame)]);
  for (const auto& group : fields.groups()) result["groups"].push_back(drawn_group(fields, group, frames));
  return result;
}

}  // namespace

json report_data(const fs::path& result) {
  std::ifstream summary(result / "summary.json");
  if (!summary)
    throw core::ConfigError("'" + result.string() + "' holds no result: there is no summary.json");
  return {{"summary", json::parse(summary)},
          {"probes", curves(result / "probes.csv")},
          {"energy", stacked(result / "energy.csv")},
          {"views", views(result / "fields.h5")}};
}

fs::path write_report(const fs::path& result) {
  const json data = report_data(result);
  const fs::path page = result / "report.html";
  core::replace_file(page,
                     page::make(report_page_template, data.at("summary").value("title", "Result"), data));
  return page;
}

}  // namespace talus::report
