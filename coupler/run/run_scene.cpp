#include "coupler/run/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "core/output/result_folder.hpp"
#include "core/output/result_writer.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "core/steps.hpp"
#include "coupler/run/checkpoints.hpp"
#include "coupler/run/choose_scheme.hpp"
#include "coupler/run/prepared_run.hpp"
#include "coupler/run/reporter.hpp"
#include "coupler/run/sources.hpp"
#include "coupler/run/summary.hpp"
#include "coupler/schemes/commands.hpp"
#include "coupler/schemes/free_flight.hpp"
#include "coupler/schemes/uncoupled.hpp"

namespace talus::coupler {
namespace {

using core::RunStatus;

constexpr double rows_of_a_run = 200;  // where output.every is not given
constexpr std::int64_t one_window = 1;

Reporter::Plan plan_of(const PreparedRun& run) {
  const Span span{.end = run.scene.time.end, .window_length = run.window_length()};
  const core::OutputScene& output = run.scene.output;
  Reporter::Plan plan{.span = span,
                      .rows = Schedule(span, output.every > 0 ? output.every : span.end / rows_of_a_run),
                      .frames = {},
                      .limited_by = tightest_name(run.limits)};
  if (output.fields_every) plan.frames.emplace(span, *output.fields_every);
  return plan;
}

/// A run through time: where it begins, what it writes.
struct Course {
  Span span;
  Reporter& reporter;
  std::optional<RestartPoint>& restart;
  Checkpoints::Plan checkpoints;

  /// Windows from the first to the last, or to a request to stop between two of them.
  /// @param start after the first report of a run from time 0
  /// @param compute from the start of this regular window, so many at most; says how many it got over
  template <class Start, class Compute>
  RunStatus run(Session& session, const ArchiveOwnState& archive, Start&& start, Compute&& compute) {
    Checkpoints written(session, checkpoints, archive);
    if (restart) restart->restore(session, checkpoints.folder, archive);
    const std::int64_t first = restart ? restart->window() : 0;
    reporter.begin_at(first);
    for (std::int64_t n = first; n < span.windows();) {
      reporter.at(n);
      if (n == 0) start();
      written.at(n);
      if (core::stop_requested()) {
        reporter.last(n);
        written.write(n);
        return RunStatus::interrupted;
      }
      n += compute(span.window(n), std::min(reporter.next_due(), span.windows()) - n);
    }
    reporter.last(span.windows());
    return RunStatus::finished;
  }
};

/// The sides of a run and their output, put together once everything about them is known.
struct Assembled {
  explicit Assembled(PreparedRun& run) {
    for (Peer* peer : run.session->peers()) peers.emplace_back(*peer);
    for (const auto& peer : peers) sources.push_back(&peer);
    if (!run.interface) return;
    exchange.emplace(*run.session, run.interface->tie.mapping);
    if (run.scene.coupling.longest_window) flight.emplace(*exchange, run.scene.longest_window());
    sources.push_back(&interface.emplace(*run.interface, *run.session->find(Role::particles), *exchange));
  }
  std::vector<PeerSource> peers;
  std::optional<Exchange> exchange;
  std::optional<FreeFlight> flight;  ///< absent: all windows are regular
  std::optional<InterfaceSource> interface;
  std::vector<const core::OutputSource*> sources;
};

/// The folder of the result that a run goes on from, as it is named and where links lead.
bool holds_checkpoint(const std::filesystem::path& folder, const std::filesystem::path& checkpoint) {
  std::error_code absent;
  const auto named = std::filesystem::absolute(checkpoint),
             real = std::filesystem::weakly_canonical(checkpoint, absent);
  return std::filesystem::equivalent(folder, named.parent_path(), absent) ||
         std::filesystem::equivalent(folder, real.parent_path(), absent);
}

std::filesystem::path folder_of(const RunRequest& request) {
  std::filesystem::path folder = request.options.folder_for(request.scene);
  if (request.restart.empty()) return folder;
  if (request.options.out.empty()) folder += "_restarted";
  if (!holds_checkpoint(folder, request.restart)) return folder;
  throw core::ConfigError(fmt::format(
      "'{}' is the folder of the checkpoint, which the new result would replace; choose another with "
      "--out",
      folder.string()));
}

RunIdentity identity_of(const PreparedRun& run) {
  RunIdentity identity{.scene_hash = run.file.hash(),
                       .scheme = name_of(run.scene.coupling.scheme),
                       .programs = {{"program of the coupler", "talus " + core::version()}},
                       .scene = flattened(run.file)};
  for (const Peer* peer : run.session->peers())
    identity.programs[std::string("program of the ") + name_of(peer->role())] = peer->declaration().program;
  return identity;
}

/// Before time 0, since nobody wants to hear it when the power fails.
void refuse_missing_checkpoints(const PreparedRun& run, const RunRequest& request) {
  const std::string unable = without_checkpoints(*run.session);
  if (unable.empty() || (!run.scene.coupling.checkpoint_every && request.restart.empty())) return;
  throw core::ConfigError(fmt::format("{} neither writes nor reads checkpoints, but {} wants them", unable,
                                      request.restart.empty() ? "coupling.checkpoint_every" : "--restart"));
}

/// The rows before the checkpoint come from the result it was written in.
void continue_result(core::ResultWriter& results, const RunRequest& request, double time) {
  const std::int64_t rows = results.take_over(std::filesystem::absolute(request.restart).parent_path(), time);
  results.summary()["restarted"] = {
      {"from", request.restart.string()}, {"time_s", time}, {"rows_taken_over", rows}};
}

core::ResultWriter::Options result_options(const PreparedRun& run, const RunRequest& request,
                                           const Reporter::Plan& plan) {
  return {.folder = folder_of(request),
          .existing = request.options.existing,
          .title = run.file.title(),
          .program = "talus " + core::version(),
          .scene = request.scene,
          .scene_hash = run.file.hash(),
          .frame_capacity = plan.frames ? plan.frames->count(plan.span.windows()) : 0,
          .energy_error = run.scene.output.energy_error()};
}

/// What a strong scheme's iterations cost goes into the summary; the others have none.
template <class Scheme>
void add_tally(nlohmann::json& summary, const Scheme& scheme, double window_length) {
  if constexpr (requires { scheme.tally(); }) add_iterations(summary, scheme.tally(), window_length);
}

/// Of the nodes that forces move; 1 kg where none are, and nothing depends on it.
double mean_mass(const std::vector<double>& masses) {
  double sum = 0, count = 0;
  for (const double mass : masses) {
    if (!(mass > 0) || !std::isfinite(mass)) continue;
    sum += mass;
    ++count;
  }
  return count > 0 ? sum / count : 1;
}

template <class Scheme>
RunStatus compute_coupled(Session& session, Assembled& parts, Scheme& scheme, Course& course) {
  Exchange& exchange = *parts.exchange;
  auto& flight = parts.flight;
  return course.run(
      session,
      [&](core::StateArchive& archive) {
        exchange.archive(archive);
        if (flight) flight->archive(archive);
        if constexpr (requires { scheme.archive(archive); }) scheme.archive(archive);
      },
      [&] { exchange.start(); },
      [&](const Window& window, std::int64_t most) {
        const std::int64_t flown = flight ? flight->compute(window, most) : 0;
        if (flown > 0) return flown;
        scheme.compute(exchange, window);
        return one_window;
      });
}

/// Where the structure is, for another scene.
void keep_final_state(PreparedRun& run, const Course& course) {
  Peer* structure = run.session->find(Role::structure);
  if (structure == nullptr || !structure->declaration().checkpoints) return;
  Command command = command_at(course.span.window(course.span.windows()), Action::write_checkpoint);
  command.path =
      std::filesystem::absolute(course.checkpoints.folder / core::ResultFolder::state_file()).string();
  run.session->ask(*structure, command);
}

RunStatus compute(PreparedRun& run, Assembled& parts, Course& course, nlohmann::json& summary) {
  RunStatus status{};
  if (parts.exchange) {
    const SchemeFacts facts{.node_mass = mean_mass(run.interface->boundary_masses),
                            .most_halvings = run.scene.most_halvings()};
    std::visit(SchemeChoice(*parts.exchange, facts,
                            [&](auto& scheme) {
                              status = compute_coupled(*run.session, parts, scheme, course);
                              add_tally(summary, scheme, run.window_length());
                            }),
               run.scene.coupling.scheme);
    if (parts.flight) add_flight(summary, parts.flight->tally(), run.window_length());
  } else {
    status = course.run(
        *run.session, [](core::StateArchive&) {}, [] {},
        [&](const Window& window, std::int64_t) {
          Uncoupled{}.compute(*run.session, window);
          return one_window;
        });
  }
  add_work(summary, *run.session);
  if (run.scene.output.final_state) keep_final_state(run, course);
  run.session->finish();
  return status;
}

core::ExitCode run_prepared(PreparedRun& run, const RunRequest& request) {
  refuse_unstable_steps(run.limits, request.scene);
  refuse_missing_checkpoints(run, request);
  Reporter::Plan plan = plan_of(run);
  std::optional<RestartPoint> restart;
  if (!request.restart.empty()) restart.emplace(request.restart, plan.span).compare(identity_of(run));
  Assembled parts(run);
  core::ResultWriter results(result_options(run, request, plan), parts.sources);
  core::open_log_file(results.folder() / "log.txt");
  for (const auto& warning : warnings_of(run.limits)) core::log_warning(warning);
  for (Peer* peer : run.session->peers())
    for (const auto& warning : peer->declaration().warnings) core::note_warning(warning);
  if (const auto words = core::words_about_length("window", run.scene.time.end, run.scene.named_window());
      !words.empty())
    core::log_warning(words);
  add_facts(results.summary(), run);
  if (restart)
    continue_result(results, request, static_cast<double>(restart->window()) * plan.span.window_length);
  try {
    Reporter reporter(*run.session, results, plan, request.options.progress);
    Course course{.span = plan.span,
                  .reporter = reporter,
                  .restart = restart,
                  .checkpoints = {.folder = results.folder(),
                                  .every = run.scene.coupling.checkpoint_every,
                                  .span = plan.span,
                                  .identity = [&run] { return identity_of(run); }}};
    const RunStatus status = compute(run, parts, course, results.summary());
    results.finish(status, status == RunStatus::interrupted ? core::stop_reason() : "");
    core::log_info(closing_words(results.folder()));
    return status == RunStatus::finished ? core::ExitCode::success : core::ExitCode::interrupted;
  } catch (const std::exception& error) {
    results.give_up(error.what());
    throw;
  }
}

}  // namespace

core::ExitCode run_scene(const RunRequest& request) {
  core::watch_stop_signals("at the end of this window");
  try {
    PreparedRun run =
        prepare({.scene = request.scene, .threads = request.options.threads, .by_hand = request.by_hand});
    try {
      return run_prepared(run, request);
    } catch (const std::exception& error) {
      run.session->abort(error.what());
      throw;
    }
  } catch (const Interrupted&) {
    core::log_info("stopped before the first window; nothing was written");
    return core::ExitCode::interrupted;
  }
}

}  // namespace talus::coupler
