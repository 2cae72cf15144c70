#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace talus::accuracy {

/// `talus run SCENE --error-bars`, after the run.
struct ErrorBarsRequest {
  std::filesystem::path scene;
  std::filesystem::path result;   ///< of the run, which finished
  std::filesystem::path program;  ///< talus
  int jobs = 1;                   ///< companions side by side
};

/// Runs the companions of a run (causes.hpp), each in a folder of its own below `result`/error_bars, and adds
/// what they say to its summary.json as `error_bars`:
///
///     {"run_seconds", "companions_seconds": summed, "elapsed_seconds": as they ran side by side,
///      "companions": [{"cause", "what", "size", "changes": {key: value}, "good", "message", "seconds"}],
///      "peaks": {column: {"value", "kind": "bar" | "range" | "unknown" | "round-off",
///                         "below", "above", "low", "high", "relative", "causes": {name: cause}}}}
///     cause: {"kind", "below", "above", "order", "expected", "note"}
///
/// Coarser companions come first, since two of them cost less than the run. One above a limit of a side, or
/// that fails, is made up for by finer ones; a third run is spared where two differ by less than
/// `worth_a_third` of every peak.
/// @returns nothing left to do: false where the user asked to stop; the summary is then as it was
bool add_error_bars(const ErrorBarsRequest& request);

/// The error bars of a summary for people, a line a peak.
std::string words_about_error_bars(const nlohmann::json& summary);

/// Of a peak: two runs that differ by less need no third to tell the order.
inline constexpr double worth_a_third = 1e-3;
/// Of a peak: a range that is wider is looked at again with half the step.
inline constexpr double worth_another_look = 1e-2;

}  // namespace talus::accuracy
