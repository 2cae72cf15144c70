#pragma once

#include <span>
#include <vector>

namespace talus::coupler {

/// Work of nodal forces on the motion of their nodes, window by window:
///
///     W = sum over windows, nodes of  f . (u_end - u_start)
///
/// | symbol | variable     | meaning                               | unit | shape    | sign |
/// |--------|--------------|---------------------------------------|------|----------|----------------------------|
/// | f      | force        | mean force of the window on a node    | N    | 3 a node | as set on the surface
/// | | u      | displacement | of the node at the window's two ends  | m    | 3 a node | | | W      |
/// joules()     | work done on the surface since time 0 | J    |          | positive: surface gains    |
///
/// Exact for a force that is constant over the window, which is what a scheme passes on. Test: "work is force
/// times path, window by window" in work_meter_test.cpp.
class WorkMeter {
 public:
  /// Remembers the loaded nodes and where they are; the unloaded ones do no work.
  void begin(std::span<const double> force, std::span<const double> displacement);
  /// Adds the work since begin().
  void end(std::span<const double> displacement);
  double joules() const { return joules_; }

 private:
  struct LoadedValue {
    std::size_t index;
    double force, start;
  };
  std::vector<LoadedValue> loaded_;
  double joules_ = 0;
};

}  // namespace talus::coupler
