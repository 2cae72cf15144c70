#include "coupler/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

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

/// The rows that are drawn: evenly spaced, and the last.
std::vector<std::size_t> drawn_rows(std::size_t rows) {
  std::vector<std::size_t> drawn;
  const std::size_t stride = rows / most_points + 1;
  for (std::size_t i = 0; i < rows; i += stride) drawn.push_back(i);
  if (rows > 0 && drawn.back() != rows - 1) drawn.push_back(rows - 1);
  return drawn;
}

json curves(const fs::path& file) {
  const core::Table table = core::read_table(file);
  const auto rows = drawn_rows(table.rows());
  json result{{"names", table.names}, {"columns", json::array()}};
  for (const auto& column : table.columns) {
    std::vector<double> drawn;
    for (const auto row : rows) drawn.push_back(column[row]);
    result["columns"].push_back(rounded(drawn));
  }
  return result;
}

std::vector<std::int64_t> drawn_frames(std::int64_t frames) {
  std::set<std::int64_t> drawn;
  for (std::int64_t i = 0; i < instants && frames > 0; ++i) drawn.insert(i * (frames - 1) / (instants - 1));
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
  const auto frames = drawn_frames(fields.frames());
  if (frames.empty()) return result;
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
          {"energy", curves(result / "energy.csv")},
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
