#include "core/program/command_line.hpp"
#include "fem_solver/app/adapter.hpp"
#include "fem_solver/app/standalone.hpp"
#include "fem_solver/app/structure.hpp"

int main(int argc, char** argv) {
  using namespace talus;
  return core::solver_main(argc, argv,
                           {.name = "fem_solver",
                            .purpose = "Computes nets, ropes and other flexible structures under loads.",
                            .example = "fem_solver configs/examples/hanging_net.yaml",
                            .schema = fem::structure_schema,
                            .run = [](const core::SolverCommand& command) {
                              return command.join.empty() ? fem::run_standalone(command)
                                                          : fem::run_coupled(command);
                            }});
}
