#pragma once

#include <thread>

#include "coupler/transport/process.hpp"

namespace talus::coupler {

/// Ends this program when its coupler dies and the program does not notice, because it computes for long or
/// was stopped. A program that waits for a command notices by itself within a slice; it gets that time before
/// this thread acts. Looks a few times a second and needs no descriptors, so that it works where they have run
/// out.
class CouplerWatch {
 public:
  /// @param role for the message; a literal
  CouplerWatch(const transport::ProcessIdentity& coupler, const char* role);

 private:
  std::jthread thread_;
};

}  // namespace talus::coupler
