#include "coupler/run/limits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/units/units.hpp"

namespace talus::coupler {

std::string CheckedLimit::text() const {
  const char* kind = limit.stability ? "stability" : "accuracy";
  return fmt::format("{}: the step of {} is {} the {} limit '{}' of {} ({})", side, core::readable(step, "s"),
                     exceeded() ? "above" : "within", kind, limit.name, core::readable(limit.seconds, "s"),
                     limit.reason);
}

std::vector<CheckedLimit> check_limits(Session& session, double window_length) {
  std::vector<CheckedLimit> checked;
  for (Peer* peer : session.peers()) {
    const Declaration& declaration = peer->declaration();
    const double step = declaration.step > 0 ? std::min(declaration.step, window_length) : window_length;
    for (const auto& limit : declaration.limits) {
      checked.push_back({.side = name_of(peer->role()),
                         .step = step,
                         .limit = limit,
                         .insisted = declaration.insists_on_step});
    }
  }
  std::stable_sort(checked.begin(), checked.end(),
                   [](const auto& a, const auto& b) { return a.limit.seconds < b.limit.seconds; });
  return checked;
}

void refuse_unstable_steps(const std::vector<CheckedLimit>& limits, const std::string& scene) {
  std::vector<core::Complaint> complaints;
  for (const auto& limit : limits) {
    if (!limit.refused()) continue;
    complaints.push_back({.file = scene, .key_path = "time.step", .message = limit.text()});
  }
  if (!complaints.empty()) throw core::ConfigError(std::move(complaints));
}

std::vector<std::string> warnings_of(const std::vector<CheckedLimit>& limits) {
  std::vector<std::string> warnings;
  for (const auto& limit : limits) {
    if (limit.exceeded()) warnings.push_back(limit.text());
  }
  return warnings;
}

std::string tightest_name(const std::vector<CheckedLimit>& limits) {
  const auto tightest =
      std::find_if(limits.begin(), limits.end(), [](const auto& l) { return l.limit.stability; });
  return tightest == limits.end() ? "" : tightest->side + ": " + tightest->limit.name;
}

std::string table_of(const std::vector<CheckedLimit>& limits) {
  std::string table = fmt::format("{:<10} {:<10} {:<40} {:>10} {:>10}  {:<9} {}\n", "side", "kind", "limit",
                                  "largest", "step", "verdict", "reason");
  for (const auto& l : limits) {
    const char* verdict = !l.exceeded()        ? "ok"
                          : !l.limit.stability ? "inexact"
                          : l.insisted         ? "insisted"
                                               : "unstable";
    table += fmt::format("{:<10} {:<10} {:<40} {:>10} {:>10}  {:<9} {}\n", l.side,
                         l.limit.stability ? "stability" : "accuracy", l.limit.name,
                         core::readable(l.limit.seconds, "s"), core::readable(l.step, "s"), verdict,
                         l.limit.reason);
  }
  return table;
}

}  // namespace talus::coupler
