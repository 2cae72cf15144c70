#include "fem_solver/app/program.hpp"

int main(int argc, char** argv) {
  return talus::fem::run_program(argc, argv);
}
