#include "core/parallel.hpp"

#include <omp.h>

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

void run_tasks(const Tasks& tasks, const void* context, void (*work)(const void*, std::int64_t)) {
  if (tasks.threads == 1 || tasks.count <= 1) {
    for (std::int64_t task = 0; task < tasks.count; ++task) work(context, task);
    return;
  }
#pragma omp parallel for schedule(dynamic) num_threads(tasks.threads)
  for (std::int64_t task = 0; task < tasks.count; ++task) work(context, task);
}

void run_team(int threads, const void* context, void (*work)(const void*, TeamMember)) {
  if (threads == 1) return work(context, {});
#pragma omp parallel num_threads(threads)
  work(context, {.rank = omp_get_thread_num(), .size = omp_get_num_threads()});
}

}  // namespace talus::core
