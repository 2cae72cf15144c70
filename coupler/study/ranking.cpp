#include "coupler/study/ranking.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

namespace talus::study {
namespace {

using nlohmann::json;

constexpr std::array budgets{0.1, 1.0, 10.0};  // s
constexpr std::array wanted_errors{0.1, 0.01, 1e-3, 1e-4, 1e-5};

bool is_below(const Interval& a, const Interval& b) {
  return a.known && b.known && a.high < b.low;
}

/// Of the points that `fits` lets pass, each method's best by `cost`, and who is better than all others.
template <class Fits, class Cost>
json best(const std::vector<Point>& points, Fits&& fits, Cost&& cost) {
  std::map<std::string, Interval> methods;
  for (const auto& point : points) {
    if (!fits(point)) continue;
    const auto [entry, is_new] = methods.try_emplace(point.method, cost(point));
    if (!is_new && cost(point).value < entry->second.value) entry->second = cost(point);
  }
  json row{{"methods", json::object()}, {"winner", nullptr}, {"tied", json::array()}};
  for (const auto& [method, interval] : methods) row["methods"][method] = to_json(interval);
  if (methods.empty()) return row;
  const auto first = std::ranges::min_element(methods, {}, [](const auto& m) { return m.second.value; });
  for (const auto& [method, interval] : methods)
    if (!is_below(first->second, interval) || method == first->first) row["tied"].push_back(method);
  if (row["tied"].size() > 1) return row;
  row["winner"] = first->first;
  row["tied"].clear();
  return row;
}

}  // namespace

json to_json(const Interval& interval) {
  if (!interval.known) return {{"value", interval.value}, {"low", nullptr}, {"high", nullptr}};
  return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

std::vector<bool> pareto_front(const std::vector<Point>& points) {
  std::vector<bool> front(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    front[i] = std::none_of(points.begin(), points.end(), [&](const Point& other) {
      const auto& own = points[i];
      const bool not_worse = other.error.value <= own.error.value && other.seconds.value <= own.seconds.value;
      return not_worse && (other.error.value < own.error.value || other.seconds.value < own.seconds.value);
    });
  return front;
}

json rankings(const std::vector<Point>& points) {
  json all{{"fastest_to", json::array()}, {"most_exact_within", json::array()}};
  for (const double error : wanted_errors) {
    json row = best(
        points, [&](const Point& p) { return p.error.high <= error; },
        [](const Point& p) { return p.seconds; });
    row["error"] = error;
    all["fastest_to"].push_back(row);
  }
  for (const double seconds : budgets) {
    json row = best(
        points, [&](const Point& p) { return p.seconds.value <= seconds; },
        [](const Point& p) { return p.error; });
    row["seconds"] = seconds;
    all["most_exact_within"].push_back(row);
  }
  return all;
}

}  // namespace talus::study
