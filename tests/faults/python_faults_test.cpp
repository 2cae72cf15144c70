#include "tests/faults/faulty_run.hpp"

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

TEST_CASE("a structure in Python that fails is named with the window, in weak and in strong schemes") {
  struct Fault {
    const char *how, *told;
    int code;
  };
  const auto fault = GENERATE(Fault{"exit", "ended with exit code 7", transport},
                              Fault{"killed", "was killed by signal 9 (SIGKILL)", transport},
                              Fault{"asleep", "gave no answer for 2 s (stuck: sleeps, ", transport},
                              Fault{"throws", "RuntimeError: the matrix is singular", transport},
                              Fault{"numerical", "displacement is not finite at step 20", numerical});
  FaultyRun run({.structure = fault.how,
                 .coupling = "timeout: 2 s, join_timeout: 60 s, " + GENERATE(from_range(schemes)),
                 .structure_program = TALUS_SOURCE_DIR "/tests/faults/dummy_structure.py"});
  const auto end = run.ended();
  CHECK(end.code == fault.code);
  CHECK_THAT(end.output, Contains(fault.told));
  if (fault.code == transport)
    CHECK_THAT(end.output, Contains("structure (dummy_structure.py, pid ") && Contains("window 20"));
  CHECK_THAT(run.summary(), Contains("\"status\": \"failed\""));
}
