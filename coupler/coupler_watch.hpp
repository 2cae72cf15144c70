#pragma once

#include <thread>

#include "coupler/transport/process.hpp"

namespace talus::coupler {

/// Ends this program when its coupler dies and the program does not notice, because it computes for long or
/// was stopped. A program that waits for a command notices by itself within a slice; it gets that time before
/// this thread acts. Sleeps until then.
class CouplerWatch {
 public:
  /// @param role for the message
  CouplerWatch(const transport::ProcessIdentity& coupler, const char* role);
  ~CouplerWatch();
  CouplerWatch(const CouplerWatch&) = delete;

 private:
  int stop_;  ///< an eventfd
  std::thread thread_;
};

}  // namespace talus::coupler
