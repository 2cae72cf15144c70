#include "coupler/study/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "coupler/study/outcome.hpp"
#include "coupler/study/ranking.hpp"
#include "coupler/study/reference.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool has_values(const json& point) {
  return point.contains("loop_seconds");
}

class QuantityAnalysis {
 public:
  QuantityAnalysis(const StudyScene& study, const Quantity& quantity, const json& points,
                   const fs::path& runs)
      : study_(study), quantity_(quantity), points_(points), runs_(runs) {}

  json operator()(const std::string& name) const {
    json result{{"name", name}, {"history", std::holds_alternative<HistoryQuantity>(quantity_.source)}};
    auto reference = ideal();
    const bool is_exact = reference.has_value();
    if (!is_exact) reference = limit(*study_.reference, result);
    if (!reference) return result;
    if (study_.second && !is_exact) hold_against_second(*reference, result);
    tell(*reference, result);
    add_errors(*reference, is_exact, result);
    return result;
  }

 private:
  /// Where the exact value is known.
  std::optional<Limit> ideal() const {
    const auto* summary = std::get_if<SummaryQuantity>(&quantity_.source);
    if (!summary || !summary->ideal) return std::nullopt;
    return Limit{.values = {{}, {*summary->ideal}}, .bar = 0, .trusted = true, .order = {}, .note = {}};
  }

  const json* point_of(const std::string& method, const std::string& value) const {
    const auto found = std::ranges::find_if(points_, [&](const json& point) {
      return point.at("method") == method && point.at("value") == value && has_values(point);
    });
    return found == points_.end() ? nullptr : &*found;
  }
  Values values_of(const json& point) const {
    return read_values(quantity_, runs_ / point.at("id").get<std::string>() / "result");
  }

  /// The finest runs that succeeded, three at most; none where one of the two finest did not.
  std::vector<Sample> samples_of(const Reference& reference, std::string& doubt) const {
    std::vector<Sample> samples;
    for (auto value = reference.values.rbegin(); value != reference.values.rend() && samples.size() < 3;
         ++value) {
      const json* point = point_of(reference.method, *value);
      if (!point) return samples.size() < 2 ? std::vector<Sample>{} : samples;
      if (point->at("not_converged").get<double>() > 0 ||
          point->at("outcome") == name_of(Outcome::inaccurate))
        doubt = fmt::format("its run at {} is itself in doubt: {}", *value,
                            point->at("detail").get<std::string>());
      samples.push_back({core::parse_quantity(*value, study_.sweep.unit).value_or(0), values_of(*point)});
      if (samples.size() > 1 && !(samples.back().step > samples[samples.size() - 2].step))
        throw core::ConfigError("the values of a reference must go from coarse to fine");
    }
    return samples;
  }

  /// Says why there is none.
  std::optional<Limit> limit(const Reference& reference, json& result) const {
    std::string doubt;
    const auto samples = samples_of(reference, doubt);
    if (samples.empty()) {
      result["note"] =
          fmt::format("the runs of '{}' that the reference needs did not succeed", reference.method);
      return std::nullopt;
    }
    Limit limit = limit_of(samples, reference.order);
    if (!doubt.empty()) {
      limit.trusted = false;
      limit.note = doubt;
    }
    return limit;
  }

  /// Two ways to the same truth: the reference is no better known than by what they differ.
  void hold_against_second(Limit& reference, json& result) const {
    json note;
    const auto second = limit(*study_.second, note);
    if (!second) {
      result["second_note"] = note.at("note");
      return;
    }
    const double differs = relative_difference(second->values, reference.values);
    result["second_differs"] = differs;
    reference.bar = std::max(reference.bar, differs);
  }

  void tell(const Limit& reference, json& result) const {
    result["trusted"] = reference.trusted;
    result["bar"] = reference.bar;
    if (!reference.note.empty()) result["why"] = reference.note;
    if (reference.order) result["observed_order"] = *reference.order;
    result["expected_order"] = study_.reference->order;
    if (result.at("history")) return;
    result["reference"] = reference.values.numbers.front();
    result["reference_low"] = reference.low();
    result["reference_high"] = reference.high();
  }

  Interval error_of(const Values& values, const Limit& reference, bool is_exact) const {
    if (is_exact)
      return Interval::exactly(std::abs(values.numbers.front() - reference.values.numbers.front()));
    const double error = relative_difference(values, reference.values);
    return {error, std::max(0.0, error - reference.bar), error + reference.bar, true};
  }

  void add_errors(const Limit& reference, bool is_exact, json& result) const {
    std::vector<Point> found;
    result["points"] = json::array();
    for (const auto& point : points_) {
      if (!point.at("shown").get<bool>() || !has_values(point)) continue;
      const auto values = values_of(point);
      const Interval error = error_of(values, reference, is_exact);
      found.push_back({point.at("method"), error, time_of(point)});
      json entry{{"error", error.value},
                 {"error_low", error.low},
                 {"error_high", error.high},
                 {"seconds", found.back().seconds.value}};
      for (const char* key : {"id", "method", "position", "value"}) entry[key] = point.at(key);
      if (!result.at("history")) entry["number"] = values.numbers.front();
      result["points"].push_back(entry);
    }
    const auto front = pareto_front(found);
    for (std::size_t i = 0; i < found.size(); ++i) result["points"][i]["front"] = static_cast<bool>(front[i]);
    result.update(rankings(found));
  }

  static Interval time_of(const json& point) {
    const json& time = point.at("loop_seconds");
    return {time.at("median"), time.at("least"), time.at("most"), time.at("runs") > 1};
  }

  const StudyScene& study_;
  const Quantity& quantity_;
  const json& points_;
  const fs::path& runs_;
};

}  // namespace

json quantity_analysis(const StudyScene& study, const std::pair<std::string, Quantity>& quantity,
                       const json& points, const fs::path& runs) {
  return QuantityAnalysis(study, quantity.second, points, runs)(quantity.first);
}

}  // namespace talus::study
