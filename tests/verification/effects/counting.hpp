#pragma once

#include <cstddef>

/// What a program costs, in figures that do not depend on the machine's mood.
namespace talus::test {

/// Something that goes through time.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void step() = 0;
};

/// Takes steps. Callgrind counts the instructions between its begin and its end
/// (--toggle-collect=*counted_steps*).
void counted_steps(Stepper& stepper, int steps);

/// Bytes of heap in use.
std::size_t heap_bytes();

}  // namespace talus::test
