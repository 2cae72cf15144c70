#include "tests/verification/effects/counting.hpp"

#include <malloc.h>

namespace talus::test {

[[gnu::noinline]] void counted_steps(Stepper& stepper, int steps) {
  for (int k = 0; k < steps; ++k) stepper.step();
}

std::size_t heap_bytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace talus::test
