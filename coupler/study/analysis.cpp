#include "coupler/study/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "coupler/study/outcome.hpp"
#include "coupler/study/quantity.hpp"
#include "coupler/study/runner.hpp"

namespace talus::study {
namespace {

using nlohmann::json;

double median(const std::vector<double>& sorted) {
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/// Null of no values.
json spread(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::ranges::sort(values);
  return {{"median", median(values)},
          {"least", values.front()},
          {"most", values.back()},
          {"runs", values.size()}};
}

/// The portable cost: what summary.json counts under "work", e.g. solver calls and force evaluations.
json work_of(const json& point) {
  return point.value("/summary/work"_json_pointer, json::object());
}

/// What is known of a planned run before one looks at what it left.
json announced(const PlannedRun& run) {
  return {{"id", run.id},         {"method", run.method}, {"value", run.value}, {"position", run.position},
          {"across", run.across}, {"shown", run.shown}};
}

void set_outcome(json& point, const Worth& worth) {
  point["outcome"] = name_of(worth.outcome);
  point["detail"] = worth.detail;
  point["message"] = worth.message;
}

json described(const PlannedRun& run, const json& point, double largest_energy_error,
               const json& fingerprint) {
  json all = announced(run);
  if (point.is_null()) {
    set_outcome(all, {.detail = "not run yet", .message = {}});
    return all;
  }
  const std::string change = difference(point.at("fingerprint"), fingerprint);
  if (!is_same_scene(point.at("fingerprint"), fingerprint)) {
    set_outcome(all, {.detail = "stale", .message = change + " since it was computed"});
    return all;
  }
  if (!change.empty()) all["stale"] = change;
  const Worth worth = worth_of(point, largest_energy_error);
  set_outcome(all, worth);
  if (!worth.has_values()) return all;
  all["not_converged"] = share_not_converged(point.at("summary"));
  all["loop_seconds"] = spread(point.at("loop_seconds"));
  all["process_seconds"] = spread(point.at("process_seconds"));
  all["energy_error"] = point.value("/summary/energy/largest_error_relative"_json_pointer, json(nullptr));
  all["work"] = work_of(point);
  return all;
}

/// Points may have been run on several machines; each is listed once, with the loads that all its runs met.
class Machines {
 public:
  void add(const json& point) {
    const json& machine = point.at("machine");
    auto known = std::ranges::find_if(all_, [&](const auto& entry) { return entry.first == machine; });
    if (known == all_.end()) {
      all_.emplace_back(machine, std::vector<double>{});
      known = std::prev(all_.end());
    }
    for (const auto& load : point.at("load_before")) known->second.push_back(load.get<double>());
  }
  json list() const {
    json list = json::array();
    for (auto [machine, loads] : all_) {
      machine["load_before"] = spread(loads);
      list.push_back(machine);
    }
    return list;
  }

 private:
  std::vector<std::pair<json, std::vector<double>>> all_;
};

const std::string& label_of(const Sweep& sweep) {
  return sweep.label.empty() ? sweep.keys.front() : sweep.label;
}

std::string in_quotes(std::string text) {
  for (auto place = text.find('"'); place != std::string::npos; place = text.find('"', place + 2))
    text.insert(place, 1, '"');
  return text.find_first_of(",\"\n") == std::string::npos ? text : '"' + text + '"';
}

/// The point's entry among a quantity's; null where it has none.
const json* entry_of(const json& quantity, const json& point) {
  if (!quantity.contains("points")) return nullptr;
  for (const auto& entry : quantity.at("points"))
    if (entry.at("id") == point.at("id")) return &entry;
  return nullptr;
}

}  // namespace

json analyse(const LoadedStudy& study, const std::vector<PlannedRun>& runs, const PointStore& store) {
  const StudyScene& scene = study.scene;
  json all{{"title", study.title},
           {"base", scene.base.filename().string()},
           {"sweep", label_of(scene.sweep)},
           {"unit", scene.sweep.unit},
           {"repeats", scene.repeats},
           {"threads", scene.threads},
           {"largest_energy_error", scene.largest_energy_error},
           {"points", json::array()},
           {"quantities", json::array()}};
  if (scene.across) all["across"] = label_of(*scene.across);
  Machines machines;
  for (const auto& run : runs) {
    const json point = read_point(run, store.folder);
    all["points"].push_back(described(run, point, scene.largest_energy_error, store.fingerprints.of(run)));
    if (all["points"].back().contains("loop_seconds")) machines.add(point);
  }
  all["machines"] = machines.list();
  for (const auto& quantity : scene.quantities)
    all["quantities"].push_back(quantity_analysis(scene, quantity, all["points"], store.folder));
  return all;
}

std::string to_csv(const json& analysis) {
  std::string text =
      "method,value,position,across,outcome,detail,runs,seconds_median,seconds_least,seconds_most";
  constexpr std::array errors{"error", "error_low", "error_high"};
  for (const auto& quantity : analysis.at("quantities"))
    for (const char* which : errors)
      text += fmt::format(",{}_{}", which, quantity.at("name").get<std::string>());
  for (const auto& point : analysis.at("points")) {
    if (!point.at("shown").get<bool>()) continue;
    text += "\n" + in_quotes(point.at("method")) + "," + in_quotes(point.at("value")) +
            fmt::format(",{},", point.at("position").get<double>()) + in_quotes(point.at("across"));
    for (const char* key : {"outcome", "detail"}) text += "," + in_quotes(point.at(key));
    for (const char* which : {"runs", "median", "least", "most"})
      text += point.contains("loop_seconds") ? "," + point.at("loop_seconds").at(which).dump() : ",";
    for (const auto& quantity : analysis.at("quantities")) {
      const json* entry = entry_of(quantity, point);
      for (const char* which : errors) text += entry ? "," + entry->at(which).dump() : ",";
    }
  }
  return text + "\n";
}

}  // namespace talus::study
