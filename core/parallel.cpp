#include "core/parallel.hpp"

#include <string>

#include "core/errors.hpp"

namespace talus::core {
namespace {
int threads = 1;
}

void set_thread_count(int count) {
  if (count < 1) throw UsageError("at least one thread is needed, not " + std::to_string(count));
  threads = count;
}
int thread_count() noexcept {
  return threads;
}

}  // namespace talus::core
