#include "coupler/tune/trials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/program/log.hpp"
#include "core/units/units.hpp"
#include "coupler/study/scene_text.hpp"

namespace talus::tune {
namespace {

namespace fs = std::filesystem;
using study::Ending;

/// s; starting and ending the programs of a run, beside its time loop.
constexpr double around_a_run = 5;
/// Of a time limit; shorter ones would end runs that only met a busy machine.
constexpr double shortest_limit = 10;

Trial trial_of(const study::PlannedRun& run, const Candidate& candidate, const nlohmann::json& record) {
  Trial trial{.id = run.id,
              .name = candidate.name(),
              .candidate = candidate,
              .ending = {},
              .message = {},
              .summary = {},
              .seconds = {}};
  trial.ending = record.at("ending");
  trial.message = record.at("message");
  trial.good = trial.ending == study::name_of(Ending::good);
  if (!trial.good) return trial;
  trial.summary = record.at("summary");
  trial.seconds = record.at("loop_seconds").get<std::vector<double>>();
  return trial;
}

}  // namespace

Trials::Trials(const Options& options)
    : options_(options),
      runner_(
          {.program = options.program, .folder = options.folder, .repeats = 1, .threads = options.threads}),
      started_(std::chrono::steady_clock::now()) {
  fs::create_directories(options.folder);
}

double Trials::seconds_left() const {
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - started_;
  return options_.budget * (1 - reserved_) - gone.count();
}

std::optional<Trial> Trials::run_scene(const Candidate& candidate, const std::vector<study::Setting>& more,
                                       int repeats, double longest) {
  Candidate whole = candidate;
  if (!more.empty()) whole.changes.push_back({.group = {}, .name = {}, .settings = more, .reason = {}});
  const study::PlannedRun run{
      .id = whole.id(),
      .method = {},
      .value = {},
      .across = {},
      .scene = study::scene_text(whole.settings(), fs::proximate(fs::absolute(options_.scene),
                                                                 fs::absolute(options_.folder) / "run"))};
  // What is there is taken whatever the budget: nothing is run then.
  const double left = seconds_left();
  runner_.give_up_after(std::max(shortest_limit, std::min(longest + around_a_run, left)));
  if (left <= 0 && !runner_.is_complete(repeats, run)) {
    out_of_budget_ = true;
    return std::nullopt;
  }
  for (int round = 1; round <= repeats; ++round)
    if (!runner_.run_up_to(round, run)) {
      stopped_ = true;
      return std::nullopt;
    }
  return trial_of(run, candidate, study::read_point(run, options_.folder));
}

void Trials::set_given(const Candidate& given) {
  given_ = given;
  for (auto& [id, trial] : trials_)
    if (id == Candidate{}.id()) trial.candidate = given;
}

const Trial* Trials::run(const Candidate& candidate, int repeats, double longest) {
  const bool is_own = candidate.clock.sides.empty() || candidate.id() == given_.id();
  const Candidate planned = is_own ? Candidate{} : candidate;
  const std::string id = planned.id();
  const auto known = trials_.find(id);
  if (known != trials_.end() &&
      (!known->second.good || static_cast<int>(known->second.seconds.size()) >= repeats))
    return &known->second;
  auto trial = run_scene(planned, {}, repeats, longest);
  if (!trial) return nullptr;
  if (is_own) trial->candidate = given_;
  core::log_info(
      fmt::format("{}: {}", trial->name,
                  trial->good ? core::readable(trial->least(), "s") : trial->ending + ", " + trial->message));
  return &trials_.insert_or_assign(id, std::move(*trial)).first->second;
}

std::optional<Trial> Trials::run_beside(const Candidate& candidate, const std::vector<study::Setting>& more) {
  return run_scene(candidate, more, 1, HUGE_VAL);
}

}  // namespace talus::tune
