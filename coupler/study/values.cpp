#include "coupler/study/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/table.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json summary_of(const fs::path& result) {
  return json::parse(std::ifstream(result / "summary.json"));
}

Values single(const json& summary, const std::string& pointer) {
  const json::json_pointer place(pointer);
  if (!summary.contains(place) || !summary.at(place).is_number())
    throw core::ConfigError(fmt::format("the summary of the runs has no number {}", pointer));
  return {{}, {summary.at(place).get<double>()}};
}

Values history(const HistoryQuantity& quantity, const fs::path& result) {
  const core::Table table = core::read_table(result / "probes.csv");
  const auto* column = table.column(quantity.column);
  if (!column)
    throw core::ConfigError(fmt::format("probes.csv of the runs has no column '{}'", quantity.column));
  Values values;
  for (std::size_t i = 0; i < table.rows() && table.columns.front()[i] <= quantity.until.value_or(HUGE_VAL);
       ++i) {
    values.times.push_back(table.columns.front()[i]);
    values.numbers.push_back((*column)[i]);
  }
  return values;
}

/// Linear between the rows; constant before the first and after the last.
double at_time(const Values& values, double time) {
  const auto after = std::lower_bound(values.times.begin(), values.times.end(), time);
  if (after == values.times.begin()) return values.numbers.front();
  if (after == values.times.end()) return values.numbers.back();
  const auto i = static_cast<std::size_t>(after - values.times.begin());
  const double share = (time - values.times[i - 1]) / (values.times[i] - values.times[i - 1]);
  return values.numbers[i - 1] + share * (values.numbers[i] - values.numbers[i - 1]);
}

double number_at(const Values& values, const Values& like, std::size_t i) {
  return like.times.empty() ? values.numbers.at(i) : at_time(values, like.times[i]);
}

}  // namespace

Values read_values(const Quantity& quantity, const fs::path& result) {
  if (const auto* peak = std::get_if<PeakQuantity>(&quantity.source))
    return single(summary_of(result), "/peaks/" + peak->column + "/value");
  if (const auto* number = std::get_if<SummaryQuantity>(&quantity.source))
    return single(summary_of(result), number->pointer);
  return history(std::get<HistoryQuantity>(quantity.source), result);
}

double change(const Values& a, const Values& b) {
  if (b.times.empty()) return a.numbers.at(0) - b.numbers.at(0);
  double sum = 0;
  for (std::size_t i = 0; i < b.numbers.size(); ++i) {
    const double d = at_time(a, b.times[i]) - b.numbers[i];
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(b.numbers.size()));
}

Values beyond(const Values& fine, const Values& coarse, double weight) {
  Values further = fine;
  for (std::size_t i = 0; i < fine.numbers.size(); ++i)
    further.numbers[i] += weight * (fine.numbers[i] - number_at(coarse, fine, i));
  return further;
}

double relative_difference(const Values& a, const Values& b) {
  double size = 0;
  for (const double number : b.numbers) size += number * number;
  size = std::sqrt(size / static_cast<double>(std::max<std::size_t>(1, b.numbers.size())));
  const double difference = std::abs(change(a, b));
  return size > 0 ? difference / size : difference;
}

}  // namespace talus::study
