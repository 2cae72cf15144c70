#include "coupler/study/runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/program/log.hpp"
#include "coupler/study/child_run.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Ended {
  Ending ending = Ending::good;
  std::string message;
};

Ended judge(const ChildEnd& end, const fs::path& log, double time_limit) {
  if (end.reason == ChildEnd::Reason::time_limit)
    return {Ending::too_slow, fmt::format("given up after {} s", time_limit)};
  if (end.reason == ChildEnd::Reason::killed)
    return {Ending::ended_by_the_machine, fmt::format("killed by signal {}; {}", end.code, last_line(log))};
  switch (static_cast<core::ExitCode>(end.code)) {
    case core::ExitCode::success:
      return {};
    case core::ExitCode::numerical:
      return {Ending::unstable, last_line(log)};
    case core::ExitCode::config:
      return {Ending::refused, last_line(log)};
    default:
      return {Ending::ended_by_the_machine, fmt::format("exit code {}: {}", end.code, last_line(log))};
  }
}

/// Nobody reads the time of a run that is only there for the reference.
int wanted(int repeats, const PlannedRun& run) {
  return run.shown ? repeats : std::min(repeats, 1);
}

}  // namespace

const char* name_of(Ending ending) {
  switch (ending) {
    case Ending::good:
      return "good";
    case Ending::unstable:
      return "unstable";
    case Ending::refused:
      return "refused";
    case Ending::too_slow:
      return "too slow";
    case Ending::ended_by_the_machine:
      break;
  }
  return "ended by the machine";
}

Runner::Runner(const RunnerOptions& options)
    : options_(options),
      fingerprints_(options.program, options.folder, options.threads),
      machine_(machine_record()) {}

bool Runner::is_done(const json& record, int repeats, const PlannedRun& run) const {
  const auto ending = record.at("ending");
  if (ending == name_of(Ending::good))
    return static_cast<int>(record.at("loop_seconds").size()) >= wanted(repeats, run);
  if (ending == name_of(Ending::too_slow)) return record.at("time_limit") >= options_.time_limit;
  return ending != name_of(Ending::ended_by_the_machine);
}

/// The record of the point, or a new one without any run where there is none that still stands for it.
json Runner::record_to_continue(const PlannedRun& run) {
  const json fingerprint = fingerprints_.of(run);
  json record = read_point(run, options_.folder);
  if (!record.is_null()) {
    const std::string change = difference(record.at("fingerprint"), fingerprint);
    if (change.empty() && record.at("machine") == machine_) return record;
    core::log_info(fmt::format("{}: computed anew, {}", run.id,
                               change.empty() ? "its times are of another machine" : change));
  }
  return {{"fingerprint", fingerprint},
          {"machine", machine_},
          {"time_limit", options_.time_limit},
          {"ending", name_of(Ending::ended_by_the_machine)},
          {"message", ""},
          {"loop_seconds", json::array()},
          {"process_seconds", json::array()},
          {"load_before", json::array()}};
}

bool Runner::is_complete(int repeats, const PlannedRun& run) {
  return given_up_.contains(run.id) || is_done(record_to_continue(run), repeats, run);
}

bool Runner::run_up_to(int repeats, const PlannedRun& run) {
  if (given_up_.contains(run.id)) return true;
  json record = record_to_continue(run);
  return is_done(record, repeats, run) || run_once(std::move(record), run);
}

bool Runner::run_once(json record, const PlannedRun& run) {
  const fs::path part = options_.folder / fmt::format("{}.part-{}", run.id, ::getpid());
  fs::remove_all(part);
  fs::create_directories(part);
  core::replace_file(part / "scene.yaml", run.scene);
  const double load = load_.now();
  const ChildEnd end = run_child(
      {options_.program.string(), "run", (part / "scene.yaml").string(), "--out", (part / "result").string(),
       "--overwrite", "--quiet", "--threads", std::to_string(options_.threads)},
      part / "output.txt", options_.time_limit);
  const bool stopped = end.reason == ChildEnd::Reason::stop_requested;
  const Ended ended = stopped ? Ended{} : judge(end, part / "output.txt", options_.time_limit);
  if (ended.ending == Ending::ended_by_the_machine) {
    given_up_.insert(run.id);
    core::log_warning(
        fmt::format("{} was ended by the machine and will be tried again when the study is called again: {}",
                    run.id, ended.message));
  }
  const bool has_good_runs = !record.at("loop_seconds").empty();
  if (stopped || (ended.ending == Ending::ended_by_the_machine && has_good_runs)) {
    fs::remove_all(part);
    return !stopped;
  }
  record["ending"] = name_of(ended.ending);
  record["message"] = ended.message;
  record["time_limit"] = options_.time_limit;
  if (ended.ending == Ending::good) {
    record["summary"] = json::parse(std::ifstream(part / "result" / "summary.json"));
    record["loop_seconds"].push_back(record["summary"].at("wall_time_s"));
    record["process_seconds"].push_back(end.seconds);
    record["load_before"].push_back(load);
  }
  core::replace_file(part / "point.json", record.dump(1) + "\n");
  fs::remove_all(options_.folder / run.id);
  fs::rename(part, options_.folder / run.id);
  return true;
}

json read_point(const PlannedRun& run, const fs::path& folder) {
  std::ifstream file(folder / run.id / "point.json");
  if (!file) return nullptr;
  const json point = json::parse(file, nullptr, false);
  const bool is_record = point.is_object() && point.contains("fingerprint") && point.contains("ending");
  return is_record ? point : json(nullptr);
}

std::vector<std::vector<std::size_t>> interleaved(const std::vector<PlannedRun>& runs) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto [place, is_new] = places.try_emplace({runs[i].across, runs[i].value}, groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(i);
  }
  return groups;
}

}  // namespace talus::study
