#include "fem_solver/app/program.hpp"

#include "core/program/command_line.hpp"
#include "fem_solver/app/adapter.hpp"
#include "fem_solver/app/standalone.hpp"
#include "fem_solver/app/structure.hpp"

namespace talus::fem {

int run_program(int argc, char** argv) {
  return core::solver_main(argc, argv,
                           {.name = "fem_solver",
                            .purpose = "Computes nets, ropes and other flexible structures under loads.",
                            .example = "fem_solver configs/examples/hanging_net.yaml",
                            .schema = structure_schema,
                            .run = [](const core::SolverCommand& command) {
                              return command.join.empty() ? run_standalone(command) : run_coupled(command);
                            }});
}

}  // namespace talus::fem
