#include "core/program/command_line.hpp"
#include "dem_solver/app/adapter.hpp"
#include "dem_solver/app/particle_run.hpp"
#include "dem_solver/app/standalone.hpp"

using namespace talus;

namespace {

core::ExitCode run(const core::SolverCommand& command) {
  if (command.join.empty()) return dem::run_standalone(command);
  return coupler::take_part({.segment = command.join, .role = coupler::Role::particles},
                            [&](coupler::Participant& participant) {
                              dem::serve_particles(core::SceneFile::load(command.scene), participant);
                            });
}

}  // namespace

int main(int argc, char** argv) {
  return core::solver_main(argc, argv,
                           {.name = "dem_solver",
                            .purpose = "Moves spheres that meet each other, planes, wires and faces.",
                            .example = "dem_solver configs/examples/bouncing_spheres.yaml",
                            .schema = dem::schema,
                            .run = run});
}
