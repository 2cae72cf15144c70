#pragma once

#include <string>
#include <vector>

#include "coupler/session/session.hpp"

/// The step limits that participants declared, against the steps they are going to take.
namespace talus::coupler {

struct CheckedLimit {
  std::string side;  ///< "structure"
  double step = 0;   ///< s; that the side takes
  StepLimit limit;
  bool insisted = false;
  bool exceeded() const { return step > limit.seconds; }
  bool refused() const { return exceeded() && limit.stability && !insisted; }
  /// One sentence for the table's reader.
  std::string text() const;
};

/// Tightest first.
std::vector<CheckedLimit> check_limits(Session& session, double window_length);

/// @throws core::ConfigError where a stability limit is exceeded and the scene does not insist
void refuse_unstable_steps(const std::vector<CheckedLimit>& limits, const std::string& scene);
/// A sentence for each limit that is exceeded.
std::vector<std::string> warnings_of(const std::vector<CheckedLimit>& limits);
/// "structure: bars" or empty: the tightest stability limit.
std::string tightest_name(const std::vector<CheckedLimit>& limits);
std::string table_of(const std::vector<CheckedLimit>& limits);

}  // namespace talus::coupler
