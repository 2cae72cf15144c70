#include "coupler/run/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "core/units/units.hpp"
#include "coupler/launch/find_solver.hpp"

namespace talus::coupler {
namespace {

struct SideProgram {
  Role role;
  const char* own_program;
  const std::optional<SolverScene>& scene;
};

/// A side's program, or nothing with a complaint where the scene names one that is not there.
std::optional<launch::Program> program_of(const SideProgram& side, const core::SceneFile& file, int threads,
                                          std::vector<core::Complaint>& complaints) {
  if (!side.scene->solver) {
    return launch::Program{
        side.own_program,
        {launch::own_solver(side.own_program), file.path(), "--threads", std::to_string(threads)}};
  }
  const std::string& written = *side.scene->solver;
  const std::string key_path = std::string(name_of(side.role)) + ".solver";
  auto program = launch::named_solver(written, file.path_at(key_path));
  if (program) {
    program->command.push_back(file.path());
  } else {
    complaints.push_back(
        {.file = file.path(),
         .key_path = key_path,
         .message = "names the program '" + written +
                    "', which is not there: looked relative to the scene, beside talus, and on PATH"});
  }
  return program;
}

/// Tells whoever starts a side by hand how to.
void announce(const SideProgram& side, const core::SceneFile& file, const Session& session, double seconds) {
  core::log_info(fmt::format("waits {} for the {}; start it with\n  {} {} --join {}",
                             core::readable(seconds, "s"), name_of(side.role),
                             side.scene->solver.value_or(side.own_program),
                             std::filesystem::absolute(file.path()).string(), session.segment_name()));
}

std::unique_ptr<Session> open_session(const CouplingScene& coupling) {
  transport::remove_stale_segments();
  return std::make_unique<Session>(transport::create_shared_segment(),
                                   SessionOptions{.timeout = coupling.timeout,
                                                  .join_timeout = coupling.join_timeout,
                                                  .interrupted = core::stop_requested});
}

/// In a window that grew, one step would be as long, over whatever stands in its way.
void refuse_growth_without_steps(Session& session) {
  for (const Peer* peer : session.peers())
    if (peer->declaration().step <= 0)
      throw core::ConfigError(
          fmt::format("coupling.longest_window: windows grow only where both sides have steps of their own "
                      "(`time.step`, or `step` of the side); {} takes one step a window, whatever its length",
                      peer->declaration().program));
}

/// Of a side that nobody is coupled with, its own step serves as the window.
double step_of_the_only_side(Session& session) {
  const Declaration& only = session.peers().front()->declaration();
  if (only.step > 0) return only.step;
  throw core::ConfigError(fmt::format(
      "time.step: is missing, and so is 'coupling.window'; {} has no step of its own", only.program));
}

}  // namespace

PreparedRun prepare(const PrepareOptions& options) {
  std::vector<core::Complaint> complaints;
  core::SceneFile file = core::SceneFile::load(options.scene);
  CoupledScene scene = read_coupled_scene(file, complaints);
  PreparedRun run{
      .file = std::move(file), .scene = std::move(scene), .session = nullptr, .interface = {}, .limits = {}};
  run.session = open_session(run.scene.coupling);
  for (const SideProgram& side : {SideProgram{Role::structure, "fem_solver", run.scene.structure},
                                  SideProgram{Role::particles, "dem_solver", run.scene.particles}}) {
    const bool by_hand = std::ranges::find(options.by_hand, side.role) != options.by_hand.end();
    if (!side.scene && by_hand)
      throw core::ConfigError(fmt::format("--wait {0}: the scene has no section '{0}'", name_of(side.role)));
    if (!side.scene) continue;
    if (by_hand) {
      run.session->await(side.role);
      announce(side, run.file, *run.session, run.scene.coupling.join_timeout);
      continue;
    }
    const auto program = program_of(side, run.file, options.threads, complaints);
    if (!program) continue;
    const bool foreign = side.scene->solver.has_value();
    if (foreign && !options.trust) {
      run.not_asked.push_back({side.role, program->file});
      continue;
    }
    if (foreign)
      core::log_info(fmt::format("the program of the {} is {}", name_of(side.role), program->file.string()));
    run.session->launch(side.role, *program);
  }
  run.session->wait_joined();
  std::optional<InterfacePlan> plan;
  if (run.scene.interface) plan = plan_of(*run.scene.interface);
  run.interface = introduce(*run.session, plan, std::move(complaints));
  if (run.window_length() <= 0) run.scene.coupling.window = step_of_the_only_side(*run.session);
  if (run.scene.coupling.longest_window) refuse_growth_without_steps(*run.session);
  const WindowLengths windows{
      .regular = run.window_length(),
      .longest = run.window_length() * static_cast<double>(run.scene.longest_window())};
  lay_out_arrays(*run.session, run.interface, windows, run.scene.coupling.order());
  run.limits = check_limits(*run.session, windows.longest);
  return run;
}

}  // namespace talus::coupler
