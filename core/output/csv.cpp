#include "core/output/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <set>

#include "core/errors.hpp"

namespace talus::core {

CsvFile::CsvFile(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : file_(path, OutputFile::Mode::create) {
  std::set<std::string> seen;
  for (const auto& name : columns) {
    const bool clean = !name.empty() && name.find_first_of(",\"\r\n") == std::string::npos;
    if (!clean || !seen.insert(name).second)
      throw UsageError("'" + name + "' cannot be a column of " + path.string());
  }
  file_.append(fmt::format("{}\n", fmt::join(columns, ",")));
}

void CsvFile::write_row(std::span<const double> values) {
  line_.clear();
  for (const double value : values)
    fmt::format_to(std::back_inserter(line_), "{}{}", line_.empty() ? "" : ",", value);
  line_ += '\n';
  file_.append(line_);
}

}  // namespace talus::core
