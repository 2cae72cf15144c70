#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/output/energy_guard.hpp"
#include "core/output/ledger.hpp"
#include "core/output/result_folder.hpp"
#include "core/output/source.hpp"

namespace talus::core {

enum class RunStatus { running, finished, interrupted, failed };

/// Writes the result of one run: probes.csv, energy.csv, fields.h5 with fields.xdmf, summary.json
/// (docs/results.md describes them).
///
///     ResultWriter results({.folder = "results/cable_net", .title = ..., ...}, {&structure, &particles});
///     results.write_row(0); results.write_fields(0);
///     while (...) { ...; results.write_row(time); }
///     results.summary()["limits"] = ...;
///     results.finish(RunStatus::finished);
///
/// Files are complete up to the last call whenever the process is killed; summary.json then says "running".
class ResultWriter {
 public:
  struct Options {
    std::filesystem::path folder;
    ResultFolder::Existing existing = ResultFolder::Existing::refuse;
    std::string title = {};
    std::string program = {};          ///< "talus 0.1.0"
    std::filesystem::path scene = {};  ///< as given by the user
    std::string scene_hash = {};       ///< SceneFile::hash()
    std::int64_t frame_capacity = 0;   ///< most frames write_fields() will be called for; 0: no field files
    EnergyErrorScene energy_error = {};
  };

  /// Columns and groups of several sources stand side by side, in their order. The sources must outlive the
  /// writer.
  /// @throws ConfigError (see ResultFolder), UsageError where two columns or groups have the same name,
  /// FileError; a summary then says so, if that can be written
  ResultWriter(const Options& options, std::vector<const OutputSource*> sources);
  ~ResultWriter();

  /// Asks the sources for their probes and ledger lines and appends a row to probes.csv and energy.csv.
  /// @pre times increase. @throws NumericalError where a value is not finite; the row is then not written; and
  /// where the energy balance is lost (EnergyGuard)
  void write_row(double time);
  /// Begins with the rows of an earlier result up to, not including, `before` (s): a restarted run then ends
  /// with the tables, peaks and energy errors of a run in one piece. @pre no row is written yet
  /// @returns how many rows. @throws ConfigError where the earlier result has other columns
  std::int64_t take_over(const std::filesystem::path& earlier, double before);
  /// Appends a frame of all groups. @throws NumericalError where a value is not finite; the frame then does
  /// not count.
  void write_fields(double time);

  const std::filesystem::path& folder() const;
  std::optional<double> last_row_time() const;
  const LedgerBalance& balance() const;
  /// What the caller adds to summary.json: limits, versions, iterations, ... Keys of the writer itself win.
  nlohmann::json& summary();
  /// Writes the summary for good, on the disk when it returns. Wall time is counted from the writer's
  /// construction to this call. @throws FileError; NumericalError where a run that finished was off by more energy
  /// than allowed: give it up
  void finish(RunStatus status, const std::string& message = {});
  /// The same for a run that failed, perhaps because the disk is full: what cannot be written either is only a
  /// warning, since the first cause is what the user has to hear. Room for the summary was kept from the start.
  void give_up(const std::string& message) noexcept;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace talus::core
