#include "coupler/tune/tune.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/output/file.hpp"
#include "core/program/command_line.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "core/scene/reader.hpp"
#include "core/units/units.hpp"
#include "coupler/page/page.hpp"
#include "coupler/study/ranking.hpp"
#include "coupler/tune/neighbours.hpp"
#include "coupler/tune/overlay.hpp"
#include "coupler/tune/search.hpp"

namespace talus::tune {

extern const char* const tune_page_template;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Of the budget, that the search leaves for confirming and for the neighbours.
constexpr double for_the_end = 0.25;
constexpr int confirming_runs = 3;

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

/// "50 us" where that is the time to the last digit.
study::Setting short_time(const study::Setting& setting) {
  const double seconds = core::parse_quantity(setting.value, "s").value_or(0);
  const std::string text = core::readable(seconds, "s");
  const bool exact = std::abs(core::parse_quantity(text, "s").value_or(0) - seconds) <= 1e-12 * seconds;
  return {setting.key, exact ? text : setting.value};
}

/// The runs of a neighbouring scene with the tuned settings, and with others that are known to be exact.
struct Checked {
  std::string name;
  std::vector<double> errors{};  ///< of each goal; empty where it could not be told
  std::string note{};
  bool holds = false;
};

std::vector<Goal> parsed(const std::vector<std::string>& within) {
  std::vector<Goal> goals;
  for (const auto& text : within) goals.push_back(parse_goal(text));
  return goals;
}

class Tuning {
 public:
  explicit Tuning(const TuneRequest& request)
      : request_(request),
        scene_(core::SceneFile::load(request.scene)),
        goals_(parsed(request.within)),
        folder_(request.out.empty() ? fs::path("results") / (request.scene.stem().string() + "_tune")
                                    : request.out),
        trials_({.scene = request.scene,
                 .folder = folder_ / "runs",
                 .program = request.program.empty() ? fs::read_symlink("/proc/self/exe")
                                                    : fs::absolute(request.program),
                 .budget = 60 * request.budget,
                 .threads = request.threads}) {}

  core::ExitCode run() {
    const Trial* own = first_run();
    if (own == nullptr) return unfinished();
    check_columns(goals_, own->summary);
    given_ = Candidate{.clock = accuracy::clock_of(scene_, own->summary, accuracy::Limits::stability),
                       .changes = {}};
    if (std::ranges::all_of(given_.clock.sides, &accuracy::SideClock::fixed))
      throw core::ConfigError(request_.scene.string() +
                              ": a static structure has no step or method to choose");
    trials_.set_given(given_);
    trials_.reserve(0.5);
    const bool only_energy = std::ranges::all_of(goals_, &Goal::is_energy);
    const auto truth = only_energy ? std::optional(std::vector<Truth>(goals_.size()))
                                   : find_truth(goals_, given_, other_methods(scene_), trials_);
    if (trials_.stopped()) return core::ExitCode::interrupted;
    if (!truth)
      return told(
          "the truth is not known: three runs of the scene with ever shorter steps did not end within the "
          "budget");
    truth_ = *truth;
    trials_.reserve(for_the_end);
    found_ = search(scene_, goals_, truth_, given_, trials_);
    if (trials_.stopped()) return core::ExitCode::interrupted;
    trials_.reserve(0);
    if (!found_.best) return told(nothing_found());
    confirm();
    check_neighbours();
    if (trials_.stopped()) return core::ExitCode::interrupted;
    write_overlay();
    return told(sentence());
  }

 private:
  /// The scene as it is says what its peaks, steps and limits are. It is run through the same door as all
  /// others, with no settings at all.
  const Trial* first_run() {
    const Trial* own = trials_.run(Candidate{});
    if (own != nullptr && !own->good)
      throw core::ConfigError(fmt::format("{}: does not run as it is ({}), so nothing can be tuned: {}",
                                          request_.scene.string(), own->ending, own->message));
    return own;
  }

  core::ExitCode unfinished() const {
    if (trials_.stopped()) return core::ExitCode::interrupted;
    throw core::ConfigError("--budget: is over before the scene has run once");
  }

  std::string nothing_found() const {
    for (std::size_t g = 0; g < goals_.size(); ++g)
      if (truth_[g].bar >= goals_[g].share)
        return fmt::format("nothing can be told for '{}': the truth is known to {} only", goals_[g].text,
                           percent(truth_[g].bar));
    return found_.complete ? "none of the settings that were tried meets the goals"
                           : "the budget was over before any settings met the goals";
  }

  const Trial& best() const { return trials_.all().at(*found_.best); }
  const Trial& own() const { return trials_.all().at(Candidate{}.id()); }

  /// Timings of one minute say little: more of the two that the sentence compares, in turn.
  void confirm() {
    for (int round = 2; round <= confirming_runs; ++round) {
      trials_.run(Candidate{}, round);
      trials_.run(best().candidate, round);
    }
  }

  /// The cheapest settings that are exact enough to judge a neighbour by.
  const Trial* witness() const {
    const Trial* cheapest = nullptr;
    for (const auto& [id, trial] : trials_.all()) {
      if (!trial.good) continue;
      bool exact = true;
      for (std::size_t g = 0; g < goals_.size(); ++g)
        exact &= goals_[g].is_energy() || error_of(goals_[g], truth_[g], trial.summary) - truth_[g].bar <=
                                              goals_[g].share / sharper_than_goal;
      const bool model_kept = std::ranges::none_of(trial.candidate.changes, &Change::drops_an_effect);
      if (exact && model_kept && id != *found_.best &&
          (cheapest == nullptr || trial.least() < cheapest->least()))
        cheapest = &trial;
    }
    return cheapest;
  }

  void check_neighbours() {
    const Trial* exact = witness();
    if (exact == nullptr) return;
    witness_ = exact->id;
    for (const auto& neighbour : neighbours_of(scene_)) {
      Checked checked{.name = neighbour.name};
      const auto tuned = trials_.run_beside(best().candidate, neighbour.settings);
      const auto reference = tuned ? trials_.run_beside(exact->candidate, neighbour.settings) : std::nullopt;
      if (!tuned || !reference) {
        checked.note = "the budget was over";
      } else if (!tuned->good || !reference->good) {
        checked.note = !tuned->good ? "the tuned settings fail: " + tuned->message
                                    : "the exact settings fail: " + reference->message;
      } else {
        checked.holds = true;
        for (const auto& goal : goals_) checked.errors.push_back(neighbour_error(goal, *tuned, *reference));
        for (std::size_t g = 0; g < goals_.size(); ++g) checked.holds &= checked.errors[g] <= goals_[g].share;
      }
      neighbours_.push_back(checked);
    }
  }

  static double neighbour_error(const Goal& goal, const Trial& tuned, const Trial& reference) {
    const double value = value_of(goal, tuned.summary), truth = value_of(goal, reference.summary);
    return goal.is_energy() ? std::abs(value) : std::abs(value - truth) / std::abs(truth);
  }

  std::string sentence() const {
    std::string words;
    const double factor = own().least() / best().least();
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      const double error = error_of(goals_[g], truth_[g], best().summary),
                   before = error_of(goals_[g], truth_[g], own().summary);
      words += fmt::format(
          "{}{:.2g} times {} than the scene as given at an error of {}, for goal '{}' (the scene as given: "
          "{})",
          words.empty() ? "" : "; ", std::max(factor, 1 / factor), factor >= 1 ? "faster" : "slower",
          percent(error), goals_[g].text, percent(before));
    }
    const Trial* steps = only_steps();
    if (!meets(goals_, truth_, own()) && steps != nullptr)
      words += fmt::format(
          "; {:.2g} times faster than the scene with no more than shorter steps that meets all goals ({})",
          steps->least() / best().least(), steps->name);
    return words;
  }

  /// The cheapest that meets the goals with the scene's own methods and all its steps alike.
  const Trial* only_steps() const {
    const Trial* cheapest = nullptr;
    for (const auto& [id, trial] : trials_.all()) {
      const auto& clock = trial.candidate.clock;
      const bool alike =
          std::ranges::equal(clock.sides, given_.clock.sides, [&](const auto& a, const auto& b) {
            return std::abs(a.step / clock.window - b.step / given_.clock.window) < 1e-9 &&
                   a.mass_step == b.mass_step;
          });
      if (alike && trial.candidate.changes.empty() && meets(goals_, truth_, trial) &&
          !found_.lucky.contains(id) && (cheapest == nullptr || trial.least() < cheapest->least()))
        cheapest = &trial;
    }
    return cheapest;
  }

  /// What differs from the scene.
  std::vector<Reasoned> reasoned() const {
    std::vector<Reasoned> all;
    const Candidate& tuned = best().candidate;
    const auto before = accuracy::settings_of(given_.clock);
    for (const auto& setting : accuracy::settings_of(tuned.clock)) {
      const auto same = std::ranges::find(before, setting.key, &study::Setting::key);
      if (same == before.end())
        all.push_back(
            {short_time(setting), setting.key.ends_with("mass_scaling.step")
                                      ? "mass on light nodes, so that this step is stable"
                                      : "its own: its error asks for another step than the window"});
      else if (same->value != setting.value)
        all.push_back({short_time(setting), short_time(*same).value + " in the scene"});
    }
    for (const auto& change : tuned.changes)
      for (const auto& setting : change.settings) all.push_back({setting, change.reason});
    return all;
  }

  void write_overlay() const {
    const fs::path file = overlay_file();
    std::vector<std::string> heading{
        sentence() + ".", fmt::format("Found by talus tune within {} runs.", trials_.all().size())};
    core::replace_file(file, overlay_text(fs::proximate(fs::absolute(request_.scene), fs::absolute(folder_)),
                                          scene_.title() + ", tuned", heading, reasoned()));
  }
  fs::path overlay_file() const { return folder_ / (request_.scene.stem().string() + "_tuned.yaml"); }

  json goal_json(std::size_t g) const {
    json one{{"text", goals_[g].text}, {"share", goals_[g].share}, {"energy", goals_[g].is_energy()}};
    if (truth_.empty()) return one;
    const Truth& truth = truth_[g];
    one.update({{"truth", truth.value},
                {"bar", truth.bar},
                {"way", truth.way},
                {"second_way", truth.second_way},
                {"note", truth.note}});
    if (truth.order) one["order"] = *truth.order;
    if (truth.differs) one["differs"] = *truth.differs;
    return one;
  }

  json trial_json(const Trial& trial) const {
    json one{{"id", trial.id},
             {"name", trial.name},
             {"good", trial.good},
             {"ending", trial.ending},
             {"message", trial.message}};
    if (!trial.good) return one;
    one["seconds"] = trial.least();
    one["runs"] = trial.seconds.size();
    one["errors"] = json::array();
    for (std::size_t g = 0; g < truth_.size(); ++g)
      one["errors"].push_back(error_of(goals_[g], truth_[g], trial.summary));
    one["meets"] = !truth_.empty() && meets(goals_, truth_, trial);
    one["lucky"] = found_.lucky.contains(trial.id);
    return one;
  }

  json everything(const std::string& words) const {
    json all{{"title", scene_.title() + ": what an accuracy costs"},
             {"scene", request_.scene.filename().string()},
             {"sentence", words},
             {"program", "talus " + core::version()},
             {"budget_minutes", request_.budget},
             {"complete", found_.complete},
             {"goals", json::array()},
             {"trials", json::array()},
             {"effects", json::array()},
             {"neighbours", json::array()},
             {"machine", study::machine_record()}};
    for (std::size_t g = 0; g < goals_.size(); ++g) all["goals"].push_back(goal_json(g));
    for (const auto& [id, trial] : trials_.all()) all["trials"].push_back(trial_json(trial));
    for (const auto& effect : found_.effects)
      all["effects"].push_back({{"key", effect.key},
                                {"dropped", effect.dropped},
                                {"changes", effect.changes},
                                {"note", effect.note}});
    for (const auto& one : neighbours_)
      all["neighbours"].push_back(
          {{"name", one.name}, {"errors", one.errors}, {"holds", one.holds}, {"note", one.note}});
    all["given"] = Candidate{}.id();
    if (!witness_.empty()) all["witness"] = witness_;
    if (!found_.best) return all;
    all["best"] = *found_.best;
    all["overlay"] = json::array();
    for (const auto& one : reasoned())
      all["overlay"].push_back(
          {{"key", one.setting.key}, {"value", one.setting.value}, {"reason", one.reason}});
    return all;
  }

  core::ExitCode told(const std::string& words) const {
    const json all = everything(words);
    core::replace_file(folder_ / "tune.json", all.dump(1) + "\n");
    core::replace_file(folder_ / "index.html", page::make(tune_page_template, all.at("title"), all));
    core::log_info(words);
    if (!found_.complete) core::log_info("the budget ended the search; called again it goes on from there");
    core::log_info("the page is " + (folder_ / "index.html").string());
    if (!found_.best) return core::ExitCode::regression;
    core::log_info("the scene is " + overlay_file().string());
    return core::ExitCode::success;
  }

  TuneRequest request_;
  core::SceneFile scene_;
  std::vector<Goal> goals_;
  fs::path folder_;
  Trials trials_;
  Candidate given_;
  std::vector<Truth> truth_;
  Found found_;
  std::vector<Checked> neighbours_;
  std::string witness_;
};

}  // namespace

core::ExitCode tune(const TuneRequest& request) {
  core::watch_stop_signals("with the run in progress");
  if (request.within.empty())
    throw core::ConfigError("--within: a goal is needed, such as '2 % of peak net_centre.displacement_z_m'");
  if (!(request.budget > 0))
    throw core::ConfigError(
        fmt::format("--budget: must be greater than 0 minutes, but is {}", request.budget));
  return Tuning(request).run();
}

}  // namespace talus::tune
