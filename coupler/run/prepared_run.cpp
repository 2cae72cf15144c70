#include "coupler/run/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "core/units/units.hpp"
#include "coupler/launch/find_solver.hpp"

namespace talus::coupler {
namespace {

namespace fs = std::filesystem;

struct SideProgram {
  Role role;
  const char* own_program;
  const std::optional<core::SolverScene>& scene;

  std::string key(const char* of_the_solver) const {
    return std::string(name_of(role)) + ".solver." + of_the_solver;
  }
};

/// What a scene says about starting a side, as it is found on this machine.
class SolverStart {
 public:
  SolverStart(const SideProgram& side, const core::SceneFile& file, std::vector<core::Complaint>& complaints)
      : side_(side), scene_(*side.scene), file_(file), complaints_(complaints) {}

  /// Nothing where what the scene says of it cannot be, with a complaint.
  std::optional<launch::Program> program(int threads) {
    if (is_complained_about()) return std::nullopt;
    auto program = scene_.program ? named() : own();
    const auto folder = working_folder();
    if (!program || !folder || !add_launcher(*program)) return std::nullopt;
    const fs::path scene = file_.path();
    program->command.push_back(folder->empty() ? scene : fs::absolute(scene));
    if (!scene_.program)
      program->command.insert(program->command.end(), {"--threads", std::to_string(threads)});
    program->environment = scene_.environment;
    program->folder = *folder;
    return program;
  }

 private:
  bool is_complained_about() const {
    return std::ranges::any_of(complaints_, [this](const core::Complaint& complaint) {
      return complaint.key_path.starts_with(std::string(name_of(side_.role)) + ".solver");
    });
  }

  std::optional<launch::Program> own() {
    return launch::Program{.name = side_.own_program,
                           .command = with_arguments({launch::own_solver(side_.own_program)})};
  }

  std::optional<launch::Program> named() {
    auto program = launch::named_solver(*scene_.program, file_.path_at(side_.key("program")));
    if (program) {
      program->command = with_arguments(std::move(program->command));
    } else {
      complain("program",
               "names the program '" + *scene_.program +
                   "', which is not there: looked relative to the scene, beside talus, and on PATH");
    }
    return program;
  }

  std::vector<std::string> with_arguments(std::vector<std::string> command) const {
    command.insert(command.end(), scene_.arguments.begin(), scene_.arguments.end());
    return command;
  }

  bool add_launcher(launch::Program& program) {
    if (scene_.launcher.empty()) return true;
    const auto found = launch::on_path(scene_.launcher.front());
    if (!found) {
      complain("launcher", "names the program '" + scene_.launcher.front() + "', which is not on PATH");
      return false;
    }
    if (program.file.empty()) program.file = *found;
    program.command.insert(program.command.begin(), scene_.launcher.begin(), scene_.launcher.end());
    return true;
  }

  /// Empty: ours. Nothing: it is not there.
  std::optional<fs::path> working_folder() {
    if (!scene_.working_folder) return fs::path();
    const fs::path folder = fs::absolute(file_.path_at(side_.key("working_folder"))).lexically_normal();
    if (fs::is_directory(folder)) return folder;
    complain("working_folder",
             "is '" + *scene_.working_folder + "', but there is no folder " + folder.string());
    return std::nullopt;
  }

  void complain(const char* key, const std::string& message) {
    complaints_.push_back({.file = file_.path(), .key_path = side_.key(key), .message = message});
  }

  const SideProgram& side_;
  const core::SolverScene& scene_;
  const core::SceneFile& file_;
  std::vector<core::Complaint>& complaints_;
};

/// Tells whoever starts a side by hand how to.
void announce(const SideProgram& side, const core::SceneFile& file, const Session& session, double seconds) {
  std::string arguments;
  for (const auto& argument : side.scene->arguments) arguments += argument + " ";
  core::log_info(fmt::format("waits {} for the {}; start it with\n  {} {}{} --join {}",
                             core::readable(seconds, "s"), name_of(side.role),
                             side.scene->program.value_or(side.own_program), arguments,
                             fs::absolute(file.path()).string(), session.segment_name()));
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
    const Peer::Patience patience{.answer = side.scene->timeout.value_or(run.scene.coupling.timeout),
                                  .join = side.scene->join_timeout.value_or(run.scene.coupling.join_timeout)};
    if (by_hand) {
      run.session->await(side.role).set_patience(patience);
      announce(side, run.file, *run.session, patience.join);
      continue;
    }
    const auto program = SolverStart(side, run.file, complaints).program(options.threads);
    if (!program) continue;
    const bool foreign = side.scene->is_foreign();
    if (foreign && !options.trust) {
      run.not_asked.push_back({side.role, program->file});
      continue;
    }
    if (foreign)
      core::log_info(fmt::format("the program of the {} is {}", name_of(side.role), program->file.string()));
    run.session->launch(side.role, *program).set_patience(patience);
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
