#include "coupler/barrier/rules.hpp"

#include <array>
#include <cmath>

namespace talus::barrier {

namespace {

using nlohmann::json;

constexpr std::array class_limits{100.0, 250.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0, 4500.0};  // kJ

struct Rule {
  std::string test, what;
  json value;
  std::string unit, limit;
  json passes;
  std::string mark;
};
json as_json(const Rule& rule) {
  return {{"test", rule.test},   {"what", rule.what},     {"value", rule.value}, {"unit", rule.unit},
          {"limit", rule.limit}, {"passes", rule.passes}, {"mark", rule.mark}};
}

/// passes(value), or null where the value is not known.
template <class Passes>
json decided(const json& value, const Passes& passes) {
  return value.is_number() ? json(passes(value.get<double>())) : json(nullptr);
}

class Rules {
 public:
  void add(Rule rule) { all_.push_back(as_json(rule)); }
  json all() const { return all_; }

  /// Of every impact, whatever its energy.
  void of_impact(const std::string& name, const json& test) {
    if (!test.value("finished", false)) {
      add({name, "the run of this test ends by itself", json(nullptr), "", "finished", nullptr, "D"});
      return;
    }
    add({name, "the block is stopped", test.at("stopped").get<bool>() ? "stopped" : "goes on", "", "stopped",
         test.at("stopped"), "S"});
    const json& speed = test.at("speed_m_per_s");
    add({name, "speed of the block at the first contact", speed, "m/s", "at least 25",
         decided(speed, [](double v) { return v >= 25 - 1e-6; }), "S"});
    const json& clearance = test.at("clearance_m");
    add({name, "net and block stay off the ground until the largest elongation", clearance, "m", "above 0",
         decided(clearance, [](double z) { return z > 0; }), "R"});
    most_used(name, test);
    if (test.at("broken").is_array())  // else nothing can break
      add({name, "nothing of the barrier breaks", static_cast<double>(test.at("broken").size()), "parts",
           "none", test.at("broken").empty(), "S"});
    const json& error = test.at("energy_error");
    add({name, "the computation keeps its energy",
         error.is_number() ? json(100 * std::abs(error.get<double>())) : error, "%", "at most 2",
         decided(error, [](double e) { return std::abs(e) <= 0.02; }), "D"});
  }

  void of_height(const std::string& name, const json& test, double least, const std::string& mark) {
    const json& share = test.value("finished", false) ? test.at("residual_share") : json(nullptr);
    add({name, "height left with the block in the net",
         share.is_number() ? json(100 * share.get<double>()) : share, "%",
         "at least " + std::to_string(static_cast<int>(std::lround(100 * least))),
         decided(share, [=](double s) { return s >= least; }), mark});
  }

 private:
  void most_used(const std::string& name, const json& test) {
    json most = nullptr;
    std::string part = "ropes and posts";
    for (const json& row : test.at("forces"))
      if (row.at("utilisation").is_number() && (most.is_null() || row.at("utilisation") > most)) {
        most = row.at("utilisation");
        part = row.at("part").get<std::string>();
      }
    add({name,
         "no rope is pulled beyond its breaking load, no post pressed beyond its buckling load (most used: " +
             part + ")",
         most.is_number() ? json(100 * most.get<double>()) : most, "%", "at most 100",
         decided(most, [](double u) { return u <= 1; }), "D"});
  }

  json all_ = json::array();
};

}  // namespace

int energy_class(double kilojoules) {
  int found = -1;
  constexpr double slack = 1e-9;  // of a class whose energy is met exactly
  for (const double limit : class_limits) found += kilojoules >= limit * (1 - slack) ? 1 : 0;
  return kilojoules > class_limits.back() * (1 + slack) ? 8 : found;
}

std::string category(double residual_share) {
  return residual_share >= 0.5 ? "A" : residual_share >= 0.3 ? "B" : "C";
}

json rules_of(const Tests& tests, const BarrierSheet& sheet) {
  Rules rules;
  rules.add({"barrier", "spans of the tested barrier", static_cast<double>(sheet.posts.count - 1), "spans",
             "3", sheet.posts.count == 4, "S"});
  if (tests.contains("sel_1") && !tests.contains("sel_2"))
    rules.add({"sel_2", "the second impact without repair could not be run", json(nullptr), "", "stopped",
               nullptr, "S"});
  for (const auto& [name, test] : tests) {
    rules.of_impact(name, test);
    if (name == "sel_1") rules.of_height(name, test, 0.7, "R");
    if (name == "mel") rules.of_height(name, test, 0.3, "R");
  }
  return rules.all();
}

}  // namespace talus::barrier
