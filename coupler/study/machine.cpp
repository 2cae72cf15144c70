#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "coupler/study/runner.hpp"

namespace talus::study {
namespace {

std::string processor() {
  std::ifstream lines("/proc/cpuinfo");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

cpu_set_t allowed_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  sched_getaffinity(0, sizeof cores, &cores);
  return cores;
}

}  // namespace

nlohmann::json machine_record() {
  utsname system{};
  uname(&system);
  const cpu_set_t cores = allowed_cores();
  return {{"processor", processor()},
          {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
          {"cores_used", CPU_COUNT(&cores)},
          {"system", std::string(system.sysname) + " " + system.release}};
}

void pin_to_cores(int cores) {
  if (cores == 0) return;
  cpu_set_t allowed = allowed_cores(), chosen;
  CPU_ZERO(&chosen);
  for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&chosen) < cores; ++core)
    if (CPU_ISSET(core, &allowed)) CPU_SET(core, &chosen);
  if (sched_setaffinity(0, sizeof chosen, &chosen) != 0)
    throw std::system_error(errno, std::generic_category(), "the study cannot be pinned to its cores");
}

}  // namespace talus::study
