#pragma once

namespace talus::bench {

/// How many times the work of one thread several do in the same time, of work that cannot be shared better:
/// what no program on this machine can exceed at this moment.
struct MachineSpeedup {
  double arithmetic = 0;     ///< in registers
  double copy = 0;           ///< of arrays far larger than the caches
  double copy_gb_per_s = 0;  ///< of one thread, bytes read and written
};
MachineSpeedup measure_machine(int threads);

}  // namespace talus::bench
