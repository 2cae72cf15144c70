#include "coupler/study/runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "coupler/study/child_run.hpp"

namespace talus::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string last_line(const fs::path& file) {
  std::ifstream lines(file);
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty()) last = line;
  return last;
}

struct Ended {
  Outcome outcome = Outcome::ok;
  std::string message;
};

Ended judge(const ChildEnd& end, const fs::path& log, double time_limit) {
  if (end.reason == ChildEnd::Reason::time_limit)
    return {Outcome::too_slow, fmt::format("given up after {} s", time_limit)};
  if (end.reason == ChildEnd::Reason::killed)
    return {Outcome::failed, fmt::format("killed by signal {}; {}", end.code, last_line(log))};
  if (end.code == static_cast<int>(core::ExitCode::success)) return {};
  const bool broke_down = end.code == static_cast<int>(core::ExitCode::numerical);
  return {broke_down ? Outcome::unstable : Outcome::failed, last_line(log)};
}

/// Runs the scene in `folder` once. Nothing where a stop was requested.
std::optional<Ended> run_once(const fs::path& folder, const RunnerOptions& options, json& record) {
  const fs::path log = folder / "output.txt";
  const ChildEnd end = run_child(
      {options.program.string(), "run", (folder / "scene.yaml").string(), "--out",
       (folder / "result").string(), "--overwrite", "--quiet", "--threads", std::to_string(options.threads)},
      log, options.time_limit);
  if (end.reason == ChildEnd::Reason::stop_requested) return std::nullopt;
  const Ended ended = judge(end, log, options.time_limit);
  if (ended.outcome != Outcome::ok) return ended;
  record["process_seconds"].push_back(end.seconds);
  record["summary"] = json::parse(std::ifstream(folder / "result" / "summary.json"));
  record["loop_seconds"].push_back(record["summary"].at("wall_time_s"));
  return ended;
}

/// Nobody reads the time of a run that is only there for the reference.
int repeats_of(const PlannedRun& run, const RunnerOptions& options) {
  return run.shown ? options.repeats : 1;
}

bool is_complete(const json& point, const PlannedRun& run, const RunnerOptions& options) {
  return !point.is_null() && point.at("scene") == run.scene &&
         point.at("repeats").get<int>() >= repeats_of(run, options) && point.at("threads") == options.threads;
}

}  // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::ok:
      return "ok";
    case Outcome::failed:
      return "failed";
    case Outcome::unstable:
      return "unstable";
    case Outcome::too_slow:
      return "too slow";
  }
  return "";
}

bool run_point(const PlannedRun& run, const RunnerOptions& options) {
  if (is_complete(read_point(run, options.folder), run, options)) return true;
  const fs::path part = options.folder / fmt::format("{}.part-{}", run.id, ::getpid());
  fs::remove_all(part);
  fs::create_directories(part);
  core::replace_file(part / "scene.yaml", run.scene);
  const int repeats = repeats_of(run, options);
  json record{{"scene", run.scene},
              {"repeats", repeats},
              {"threads", options.threads},
              {"machine", machine_record()},
              {"loop_seconds", json::array()},
              {"process_seconds", json::array()}};
  Ended ended;
  for (int i = 0; i < repeats && ended.outcome == Outcome::ok; ++i) {
    const auto once = run_once(part, options, record);
    if (!once) {
      fs::remove_all(part);
      return false;
    }
    ended = *once;
  }
  record["outcome"] = name_of(ended.outcome);
  record["message"] = ended.message;
  core::replace_file(part / "point.json", record.dump(1) + "\n");
  fs::remove_all(options.folder / run.id);
  fs::rename(part, options.folder / run.id);
  return true;
}

json read_point(const PlannedRun& run, const fs::path& folder) {
  std::ifstream file(folder / run.id / "point.json");
  if (!file) return nullptr;
  const json point = json::parse(file, nullptr, false);
  return point.is_discarded() || point.at("scene") != run.scene ? json(nullptr) : point;
}

}  // namespace talus::study
