#include "core/output/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "core/errors.hpp"

namespace talus::core {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

double number(const std::string& cell, const std::filesystem::path& path) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size())
    throw ConfigError(fmt::format("'{}' in {} is no number", cell, path.string()));
  return value;
}

}  // namespace

const std::vector<double>* Table::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw ConfigError("there is no table " + path.string());
  Table table;
  std::string line;
  std::getline(file, line);
  table.names = cells_of(line);
  table.columns.resize(table.names.size());
  while (std::getline(file, line) && !file.eof()) {
    const auto cells = cells_of(line);
    if (cells.size() != table.names.size())
      throw ConfigError(fmt::format("{} has a row of {} cells under {} names", path.string(), cells.size(),
                                    table.names.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) table.columns[i].push_back(number(cells[i], path));
  }
  return table;
}

}  // namespace talus::core
