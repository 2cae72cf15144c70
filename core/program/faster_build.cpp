#include "core/program/faster_build.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace talus::core {

#if defined(__x86_64__) && !defined(__AVX2__)

namespace {

bool wants_no_other() {
  const char* const wanted = std::getenv("TALUS_CPU");
  return wanted != nullptr && std::string_view(wanted) == "x86-64";
}

/// Every processor that has these has the rest of x86-64-v3 too.
bool processor_has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}

}  // namespace

void become_faster_build(const char* const* arguments) noexcept {
  if (wants_no_other() || !processor_has_v3()) return;
  try {
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
    const auto faster = self.parent_path().parent_path() / "lib/talus/x86-64-v3/bin" / self.filename();
    execv(faster.c_str(), const_cast<char* const*>(arguments));
  } catch (...) {
    // Neither /proc nor memory: this build does it as well.
  }
}

#else

void become_faster_build(const char* const*) noexcept {}

#endif

}  // namespace talus::core
