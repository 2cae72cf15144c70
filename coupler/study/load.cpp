#include "coupler/study/load.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace talus::study {
namespace {

constexpr double shortest_look = 0.1;  // s; /proc/stat counts hundredths

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// s; of all cores, from the first line of /proc/stat: user nice system idle iowait irq softirq steal. 0 where there
/// is none.
double machine_time() {
  std::ifstream file("/proc/stat");
  std::string word;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft_irq = 0, steal = 0;
  file >> word >> user >> nice >> system >> idle >> waiting >> irq >> soft_irq >> steal;
  return (user + nice + system + irq + soft_irq + steal) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// s; of this process and its children that ended, with theirs.
double own_time() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

}  // namespace

OtherLoad::OtherLoad() : machine_(machine_time()), own_(own_time()), when_(wall_time()) {
  std::this_thread::sleep_for(std::chrono::duration<double>(1.01 * shortest_look));
  now();
}

double OtherLoad::now() {
  const double machine = machine_time(), own = own_time(), when = wall_time();
  if (when - when_ < shortest_look) return load_;
  load_ = std::max(0.0, (machine - machine_ - (own - own_)) / (when - when_));
  machine_ = machine;
  own_ = own;
  when_ = when;
  return load_;
}

}  // namespace talus::study
