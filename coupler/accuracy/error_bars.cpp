#include "coupler/accuracy/error_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/output/last_words.hpp"
#include "core/output/table.hpp"
#include "core/program/log.hpp"
#include "core/scene/reader.hpp"
#include "core/units/units.hpp"
#include "coupler/accuracy/causes.hpp"
#include "coupler/accuracy/scene_tree.hpp"
#include "coupler/regress/pool.hpp"
#include "coupler/study/child_run.hpp"
#include "coupler/study/scene_text.hpp"

namespace talus::accuracy {
namespace {

namespace fs = std::filesystem;
using coupler::regress::FinishedRun;
using coupler::regress::ScheduledRun;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// Of the largest of its direction's columns: what is smaller is round-off of a motion that does not happen.
constexpr double nothing = 1e-9;
/// A companion may take so much longer than its size lets expect; s where the run took no time.
constexpr double patience = 10, shortest_patience = 60;

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return stream ? json::parse(stream, nullptr, false) : json();
}

/// Columns of `output.stage_times`.
bool is_wall_time(const std::string& column) {
  return column.find("_time.") != std::string::npos;
}

/// A run beside the run.
struct Companion {
  std::size_t cause = 0;
  double size = 1;
  std::vector<study::Setting> settings;
  std::string id;
  bool good = false;
  double seconds = 0;
  std::string message = {};
  json peaks = {};
};

class ErrorBars {
 public:
  explicit ErrorBars(const ErrorBarsRequest& request)
      : request_(request),
        scene_(core::SceneFile::load(request.scene)),
        tree_(effective_tree(scene_)),
        summary_(read_json(request.result / "summary.json")),
        causes_(causes_of(scene_, summary_)),
        folder_(request.result / "error_bars") {}

  bool make() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const auto started = Clock::now();
    for (auto wanted = first_companions(); !wanted.empty(); wanted = further_companions()) {
      core::log_info(
          fmt::format("error bars: {} companions of the run, {} at a time", wanted.size(), request_.jobs));
      if (!run(std::move(wanted))) return false;
    }
    elapsed_ = std::chrono::duration<double>(Clock::now() - started).count();
    summary_["error_bars"] = told();
    core::replace_file(request_.result / "summary.json", core::text_of(summary_));
    return true;
  }

 private:
  std::optional<Companion> companion(std::size_t cause, double size) const {
    auto settings = causes_[cause].settings(size);
    if (!settings) return std::nullopt;
    for (const char* key : {"output.fields_every", "coupling.checkpoint_every"})
      if (node_at(tree_, key) != nullptr) settings->push_back({key, "~"});
    std::string id = fmt::format("{}_{:.3g}", causes_[cause].name, size);
    std::ranges::replace(id, ' ', '_');
    return Companion{.cause = cause, .size = size, .settings = std::move(*settings), .id = id};
  }

  /// Both coarser ones, or one of each kind, or the finer one.
  std::vector<Companion> first_companions() const {
    std::vector<Companion> wanted;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      std::size_t found = 0;
      for (const double size : causes_[i].coarser)
        if (auto one = companion(i, size)) {
          wanted.push_back(std::move(*one));
          ++found;
        } else {
          break;
        }
      if (found < 2 && !causes_[i].finer.empty())
        if (auto one = companion(i, causes_[i].finer.front())) wanted.push_back(std::move(*one));
    }
    return wanted;
  }

  bool is_tried(std::size_t cause, double size) const {
    return std::ranges::any_of(done_, [&](const auto& c) { return c.cause == cause && c.size == size; });
  }

  /// The next finer one of each cause that is worth it.
  std::vector<Companion> further_companions() const {
    std::vector<Companion> wanted;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      if (!wants_more(i)) continue;
      const auto next =
          std::ranges::find_if(causes_[i].finer, [&](double size) { return !is_tried(i, size); });
      if (next == causes_[i].finer.end()) continue;
      if (auto one = companion(i, *next)) wanted.push_back(std::move(*one));
    }
    return wanted;
  }

  bool wants_more(std::size_t cause) const {
    for (const auto& [column, peak] : summary_.at("peaks").items()) {
      if (is_wall_time(column) || is_nothing(column)) continue;
      const double size = std::abs(peak.at("value").get<double>());
      const auto samples = samples_of(cause, column);
      const Estimate found = estimate(samples, causes_[cause].expected);
      if (samples.size() < 2) return true;
      const double width = std::max(found.below, found.above) / safety_without_order;
      if (samples.size() == 2 && width > worth_a_third * size) return true;
      if (found.kind == Estimate::Kind::range && found.below + found.above > worth_another_look * size)
        return true;
    }
    return false;
  }

  bool run(std::vector<Companion> wanted) {
    std::vector<ScheduledRun> runs;
    const double seconds = summary_.at("wall_time_s");
    for (const auto& one : wanted) {
      const fs::path place = folder_ / one.id;
      fs::create_directories(place);
      core::replace_file(
          place / "scene.yaml",
          study::scene_text(one.settings, fs::proximate(fs::absolute(request_.scene), fs::absolute(place))));
      runs.push_back({.scene = place / "scene.yaml",
                      .folder = place / "result",
                      .console = place / "output.txt",
                      .time_limit = shortest_patience + patience * seconds * std::max(1.0, 1 / one.size)});
    }
    const auto finished = coupler::regress::run_side_by_side(runs, request_.jobs, request_.program);
    if (!finished) return false;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      done_.push_back(judged(std::move(wanted[i]), runs[i], (*finished)[i]));
    return true;
  }

  static Companion judged(Companion one, const ScheduledRun& run, const FinishedRun& finished) {
    one.good = !finished.too_slow && finished.status.signal == 0 && finished.status.code == 0;
    one.seconds = finished.seconds;
    if (one.good)
      one.peaks = read_json(run.folder / "summary.json").at("peaks");
    else
      one.message = finished.too_slow ? fmt::format("given up after {:.0f} s", run.time_limit)
                                      : study::last_line(run.console);
    return one;
  }

  std::vector<Sample> samples_of(std::size_t cause, const std::string& column) const {
    std::vector<Sample> samples{{1, summary_.at("peaks").at(column).at("value")}};
    for (const auto& one : done_)
      if (one.cause == cause && one.good && one.peaks.contains(column))
        samples.push_back({one.size, one.peaks.at(column).at("value")});
    return samples;
  }

  /// A direction in which nothing moves.
  bool is_nothing(const std::string& column) const {
    static const std::regex direction("_[xyz](_|$)");
    const auto kind = [](const std::string& name) { return std::regex_replace(name, direction, "_$1"); };
    double largest = 0;
    for (const auto& [name, peak] : summary_.at("peaks").items())
      if (kind(name) == kind(column)) largest = std::max(largest, std::abs(peak.at("value").get<double>()));
    return std::abs(summary_.at("peaks").at(column).at("value").get<double>()) <= nothing * largest;
  }

  static json to_json(const Estimate& found, const Orders& expected) {
    static constexpr std::array kinds{"bar", "range", "unknown"};
    json one{{"kind", kinds[static_cast<std::size_t>(found.kind)]}, {"expected", expected.text()}};
    if (found.kind != Estimate::Kind::unknown) {
      one["below"] = found.below;
      one["above"] = found.above;
    }
    if (found.order) one["order"] = *found.order;
    if (!found.note.empty()) one["note"] = found.note;
    return one;
  }

  /// All causes of a peak; their bars are added, as nothing says that they are independent.
  json peak(const std::string& column, const core::Table& probes) const {
    const double value = summary_.at("peaks").at(column).at("value");
    json all{{"value", value}, {"kind", "bar"}, {"causes", json::object()}};
    if (is_nothing(column)) {
      all["kind"] = "round-off";
      return all;
    }
    double below = 0, above = 0;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      const Estimate found = estimate(samples_of(i, column), causes_[i].expected);
      all["causes"][causes_[i].name] = to_json(found, causes_[i].expected);
      below += found.below;
      above += found.above;
      if (found.kind == Estimate::Kind::unknown) all["kind"] = "unknown";
      if (found.kind == Estimate::Kind::range && all["kind"] == "bar") all["kind"] = "range";
    }
    const auto* values = probes.column(column);
    const double rows = values ? between_rows(*values) : 0;
    all["causes"]["rows"] = {{"kind", "bar"}, {"below", rows}, {"above", rows}};
    below += rows;
    above += rows;
    all.update({{"below", below}, {"above", above}, {"low", value - below}, {"high", value + above}});
    all["relative"] = std::max(below, above) / std::abs(value);
    return all;
  }

  json told() const {
    json all{{"run_seconds", summary_.at("wall_time_s")},
             {"elapsed_seconds", elapsed_},
             {"companions", json::array()},
             {"peaks", json::object()}};
    double seconds = 0;
    for (const auto& one : done_) {
      json changes;
      for (const auto& setting : one.settings)
        if (setting.value != "~") changes[setting.key] = setting.value;
      all["companions"].push_back({{"cause", causes_[one.cause].name},
                                   {"what", causes_[one.cause].changes},
                                   {"size", one.size},
                                   {"changes", changes},
                                   {"good", one.good},
                                   {"message", one.message},
                                   {"seconds", one.seconds}});
      seconds += one.seconds;
    }
    all["companions_seconds"] = seconds;
    const core::Table probes = core::read_table(request_.result / "probes.csv");
    for (const auto& [column, value] : summary_.at("peaks").items())
      if (!is_wall_time(column)) all["peaks"][column] = peak(column, probes);
    return all;
  }

  ErrorBarsRequest request_;
  core::SceneFile scene_;
  core::SceneNode tree_;
  json summary_;
  std::vector<Cause> causes_;
  fs::path folder_;
  std::vector<Companion> done_;
  double elapsed_ = 0;
};

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

/// "steps and window 0.8 % (order 1.1), rows 0.01 %"
std::string words_about_causes(const json& peak) {
  const double size = std::abs(peak.at("value").get<double>());
  std::string words;
  for (const auto& [name, cause] : peak.at("causes").items()) {
    const double width = std::max(cause.value("below", 0.0), cause.value("above", 0.0));
    const bool is_told = cause.contains("order") || cause.contains("note");
    if (width <= unresolved * size && !is_told) continue;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name,
                         cause.at("kind") == "unknown" ? "unknown" : percent(width / size));
    if (cause.contains("note"))
      words += " (" + cause.at("note").get<std::string>() + ")";
    else if (cause.contains("order"))
      words += fmt::format(" (order {:.2g})", cause.at("order").get<double>());
  }
  return words;
}

/// "+- 0.0012 (0.4 %)", and where it is no bar: "-0.03 +0.01, a range".
std::string words_about_width(const json& peak) {
  if (peak.at("kind") == "unknown") return "with an unknown error";
  const double below = peak.at("below"), above = peak.at("above");
  const std::string share = percent(peak.at("relative"));
  if (peak.at("kind") == "bar") return fmt::format("+- {:.2g} ({})", below, share);
  return fmt::format("-{:.2g} +{:.2g} (a range, up to {})", below, above, share);
}

}  // namespace

bool add_error_bars(const ErrorBarsRequest& request) {
  return ErrorBars(request).make();
}

std::string words_about_error_bars(const json& summary) {
  const json& bars = summary.at("error_bars");
  const auto time = [&](const char* key) { return core::readable(bars.at(key).get<double>(), "s"); };
  std::string words = fmt::format(
      "numerical errors, from {} companions that took {} ({} of computing) beside {} of the run\n",
      bars.at("companions").size(), time("elapsed_seconds"), time("companions_seconds"), time("run_seconds"));
  for (const auto& [column, peak] : bars.at("peaks").items()) {
    if (peak.at("kind") == "round-off") continue;
    const std::string causes = words_about_causes(peak);
    words += fmt::format("  peak {:<36} {:>13.6g} {}{}{}\n", column, peak.at("value").get<double>(),
                         words_about_width(peak), causes.empty() ? "" : ": ", causes);
  }
  for (const auto& one : bars.at("companions"))
    if (!one.at("good").get<bool>())
      words += fmt::format("  companion '{}' at {:.3g} times the size did not end: {}\n",
                           one.at("cause").get<std::string>(), one.at("size").get<double>(),
                           one.at("message").get<std::string>());
  return words;
}

}  // namespace talus::accuracy
