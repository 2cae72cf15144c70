#include "coupler/regress/table.hpp"

#include <charconv>
#include <fstream>

#include "core/errors.hpp"

namespace talus::coupler::regress {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

double number(const std::string& cell, const core::Complaint& place) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc{} && end == cell.data() + cell.size()) return value;
  core::Complaint complaint = place;
  complaint.message = "expects a number, got '" + cell + "'";
  throw core::ConfigError(std::vector{complaint});
}

}  // namespace

Table read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  core::Complaint place{.file = path.string(), .message = "is missing or empty"};
  std::string line;
  if (!std::getline(file, line)) throw core::ConfigError(std::vector{place});
  Table table{.columns = split(line), .rows = {}};
  place.line = 1;
  while (std::getline(file, line)) {
    ++place.line;
    const auto cells = split(line);
    place.message = "has " + std::to_string(cells.size()) + " values, not one for each column";
    if (cells.size() != table.columns.size()) throw core::ConfigError(std::vector{place});
    auto& row = table.rows.emplace_back();
    for (const auto& cell : cells) row.push_back(number(cell, place));
  }
  return table;
}

}  // namespace talus::coupler::regress
