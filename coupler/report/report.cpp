#include "coupler/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/output/table.hpp"
#include "coupler/page/page.hpp"
#include "coupler/report/replay.hpp"

namespace talus::report {

extern const char* const report_page_template;
extern const char* const units_script;
extern const char* const frames_script;
extern const char* const renderer_script;
extern const char* const gestures_script;
extern const char* const legend_script;
extern const char* const replay_script;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_points = 800;  // of a curve

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

}  // namespace

std::string replay_scripts() {
  std::string elements;
  for (const char* script :
       {units_script, frames_script, renderer_script, gestures_script, legend_script, replay_script})
    elements += std::string("<script>\n") + script + "</script>\n";
  return elements;
}

json report_data(const fs::path& result) {
  std::ifstream summary(result / "summary.json");
  if (!summary)
    throw core::ConfigError("'" + result.string() + "' holds no result: there is no summary.json");
  return {{"summary", json::parse(summary)},
          {"probes", curves(result / "probes.csv")},
          {"energy", stacked(result / "energy.csv")},
          {"replay", replay(result / "fields.h5")}};
}

fs::path write_report(const fs::path& result) {
  const json data = report_data(result);
  const fs::path page = result / "report.html";
  core::replace_file(page, page::make(replay_scripts() + report_page_template,
                                      data.at("summary").value("title", "Result"), data));
  return page;
}

}  // namespace talus::report
