#include "coupler/study/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "coupler/study/runner.hpp"
#include "coupler/study/values.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array budgets{0.1, 1.0, 10.0};  // s
constexpr std::array wanted_errors{0.1, 0.01, 1e-3, 1e-4, 1e-5};
constexpr double trust = 10;  // the floor must be this much below the smallest error shown

json timing(std::vector<double> seconds) {
  if (seconds.empty()) return nullptr;
  std::sort(seconds.begin(), seconds.end());
  const std::size_t middle = seconds.size() / 2;
  const double median = seconds.size() % 2 ? seconds[middle] : (seconds[middle - 1] + seconds[middle]) / 2;
  return {{"median", median}, {"least", seconds.front()}, {"most", seconds.back()}, {"runs", seconds.size()}};
}

/// The portable cost: what summary.json counts under "work", e.g. solver calls and force evaluations.
json work_of(const json& point) {
  return point.value("/summary/work"_json_pointer, json::object());
}

json described(const PlannedRun& run, const json& point) {
  json all{{"id", run.id},         {"method", run.method}, {"value", run.value}, {"position", run.position},
           {"across", run.across}, {"shown", run.shown}};
  all["outcome"] = point.is_null() ? "missing" : point.at("outcome");
  all["message"] = point.is_null() ? "not run yet" : point.at("message");
  if (all["outcome"] != name_of(Outcome::ok)) return all;
  all["loop_seconds"] = timing(point.at("loop_seconds"));
  all["process_seconds"] = timing(point.at("process_seconds"));
  all["energy_error"] = point.value("/summary/energy/error_relative"_json_pointer, json(nullptr));
  all["work"] = work_of(point);
  return all;
}

/// Points may have been run on several machines; each is listed once, with its least load.
void add_machine(json& machines, const json& machine) {
  for (auto& known : machines) {
    if (known.at("processor") != machine.at("processor") ||
        known.at("cores_used") != machine.at("cores_used"))
      continue;
    known["load_before"] =
        std::min(known.at("load_before").get<double>(), machine.at("load_before").get<double>());
    return;
  }
  machines.push_back(machine);
}

/// One quantity's way through the study.
class QuantityAnalysis {
 public:
  QuantityAnalysis(const StudyScene& study, const Quantity& quantity, const fs::path& runs)
      : study_(study), quantity_(quantity), runs_(runs) {}

  json operator()(const std::string& name, const json& points) {
    points_ = &points;
    json result{{"name", name}, {"history", std::holds_alternative<HistoryQuantity>(quantity_.source)}};
    const auto exact = ideal();
    const auto reference = exact ? Values{{}, {*exact}} : limit(*study_.reference, result);
    if (!reference) return result;
    if (!result["history"]) result["reference"] = reference->numbers.front();
    if (study_.second && !exact) add_floor(*reference, result);
    add_errors(*reference, exact.has_value(), result);
    return result;
  }

 private:
  std::optional<double> ideal() const {
    const auto* summary = std::get_if<SummaryQuantity>(&quantity_.source);
    return summary ? summary->ideal : std::nullopt;
  }
  std::optional<Values> values_of(const std::string& method, const std::string& value) const {
    for (const auto& point : *points_)
      if (point.at("method") == method && point.at("value") == value &&
          point.at("outcome") == name_of(Outcome::ok))
        return read_values(quantity_, runs_ / point.at("id").get<std::string>() / "result");
    return std::nullopt;
  }
  double position(const std::string& value) const {
    return core::parse_quantity(value, study_.sweep.unit).value_or(0);
  }

  /// The extrapolation of a reference's two finest runs; says why there is none.
  std::optional<Values> limit(const Reference& reference, json& result) const {
    const auto& values = reference.values;
    const auto fine = values_of(reference.method, values.back()),
               coarse = values_of(reference.method, values[values.size() - 2]);
    if (!fine || !coarse) {
      result["note"] =
          fmt::format("the runs of '{}' that the reference needs did not succeed", reference.method);
      return std::nullopt;
    }
    const double ratio = position(values[values.size() - 2]) / position(values.back());
    if (!(ratio > 1)) throw core::ConfigError("the values of a reference must go from coarse to fine");
    if (fine->times.empty() && values.size() > 2)
      if (const auto coarsest = values_of(reference.method, values[values.size() - 3]))
        if (const auto order = observed_order(
                {fine->numbers.front(), coarse->numbers.front(), coarsest->numbers.front()}, ratio))
          result["observed_order"] = *order;
    return extrapolate(*fine, *coarse, {ratio, reference.order});
  }
  void add_floor(const Values& reference, json& result) const {
    if (const auto second = limit(*study_.second, result))
      result["floor"] = relative_difference(*second, reference);
  }

  void add_errors(const Values& reference, bool absolute, json& result) const {
    std::vector<Point> found;
    result["points"] = json::array();
    for (const auto& point : *points_) {
      if (!point.at("shown").get<bool>() || point.at("outcome") != name_of(Outcome::ok)) continue;
      const auto values = *values_of(point.at("method"), point.at("value"));
      const double error = absolute ? std::abs(values.numbers.front() - reference.numbers.front())
                                    : relative_difference(values, reference);
      found.push_back({point.at("method"), error, point.at("loop_seconds").at("median")});
      json entry{{"id", point.at("id")},
                 {"method", point.at("method")},
                 {"position", point.at("position")},
                 {"value", point.at("value")},
                 {"error", error},
                 {"seconds", found.back().seconds}};
      if (reference.times.empty()) entry["number"] = values.numbers.front();
      result["points"].push_back(entry);
    }
    const auto front = pareto_front(found);
    for (std::size_t i = 0; i < found.size(); ++i) result["points"][i]["front"] = static_cast<bool>(front[i]);
    add_tables(found, result);
    add_trust(found, result);
  }
  static void add_trust(const std::vector<Point>& found, json& result) {
    if (!result.contains("floor") || found.empty()) return;
    const auto least = std::min_element(found.begin(), found.end(),
                                        [](const auto& a, const auto& b) { return a.error < b.error; });
    result["trusted"] = trust * result.at("floor").get<double>() <= least->error;
  }

  /// Of the points that `fits` lets pass, each method's best by `cost`, and the winner among them.
  template <class Fits, class Cost>
  static json best(const std::vector<Point>& points, Fits&& fits, Cost&& cost) {
    json methods = json::object();
    const Point* winner = nullptr;
    for (const auto& point : points) {
      if (!fits(point)) continue;
      auto& entry = methods[point.method];
      if (entry.is_null() || cost(point) < entry.get<double>()) entry = cost(point);
      if (!winner || cost(point) < cost(*winner)) winner = &point;
    }
    return {{"methods", methods}, {"winner", winner ? json(winner->method) : json(nullptr)}};
  }
  static void add_tables(const std::vector<Point>& points, json& result) {
    for (const double seconds : budgets) {
      json row = best(
          points, [&](const Point& p) { return p.seconds <= seconds; },
          [](const Point& p) { return p.error; });
      row["seconds"] = seconds;
      result["most_exact_within"].push_back(row);
    }
    for (const double error : wanted_errors) {
      json row = best(
          points, [&](const Point& p) { return p.error <= error; }, [](const Point& p) { return p.seconds; });
      row["error"] = error;
      result["fastest_to"].push_back(row);
    }
  }

  const StudyScene& study_;
  const Quantity& quantity_;
  const fs::path& runs_;
  const json* points_ = nullptr;
};

}  // namespace

std::vector<bool> pareto_front(const std::vector<Point>& points) {
  std::vector<bool> front(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    front[i] = std::none_of(points.begin(), points.end(), [&](const Point& other) {
      const auto& own = points[i];
      const bool not_worse = other.error <= own.error && other.seconds <= own.seconds;
      return not_worse && (other.error < own.error || other.seconds < own.seconds);
    });
  return front;
}

json analyse(const LoadedStudy& study, const std::vector<PlannedRun>& runs, const fs::path& runs_folder) {
  const auto& sweep = study.scene.sweep;
  json all{{"title", study.title},
           {"base", study.scene.base.filename().string()},
           {"sweep", sweep.label.empty() ? sweep.keys.front() : sweep.label},
           {"unit", sweep.unit},
           {"repeats", study.scene.repeats},
           {"threads", study.scene.threads},
           {"points", json::array()},
           {"machines", json::array()},
           {"quantities", json::array()}};
  if (study.scene.across)
    all["across"] =
        study.scene.across->label.empty() ? study.scene.across->keys.front() : study.scene.across->label;
  for (const auto& run : runs) {
    const json point = read_point(run, runs_folder);
    all["points"].push_back(described(run, point));
    if (!point.is_null()) add_machine(all["machines"], point.at("machine"));
  }
  for (const auto& [name, quantity] : study.scene.quantities)
    all["quantities"].push_back(QuantityAnalysis(study.scene, quantity, runs_folder)(name, all["points"]));
  return all;
}

std::string to_csv(const json& analysis) {
  std::string text = "method,value,position,across,outcome,seconds_median,seconds_least,seconds_most";
  for (const auto& quantity : analysis.at("quantities"))
    text += ",error_" + quantity.at("name").get<std::string>();
  for (const auto& point : analysis.at("points")) {
    if (!point.at("shown").get<bool>()) continue;
    text += fmt::format("\n{},{},{},{},{}", point.at("method").get<std::string>(),
                        point.at("value").get<std::string>(), point.at("position").get<double>(),
                        point.at("across").get<std::string>(), point.at("outcome").get<std::string>());
    for (const char* which : {"median", "least", "most"})
      text += point.contains("loop_seconds")
                  ? fmt::format(",{}", point.at("loop_seconds").at(which).get<double>())
                  : ",";
    for (const auto& quantity : analysis.at("quantities")) {
      text += ',';
      for (const auto& entry : quantity.value("points", json::array()))
        if (entry.at("id") == point.at("id")) text += fmt::format("{}", entry.at("error").get<double>());
    }
  }
  return text + "\n";
}

}  // namespace talus::study
