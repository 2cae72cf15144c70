#pragma once

#include <filesystem>

#include "core/errors.hpp"

namespace talus::study {

/// `talus study STUDY [--out DIR] [--part I/N] [--page-only]`
struct StudyRequest {
  std::filesystem::path study;
  std::filesystem::path out;      ///< empty: results/<study file's stem>
  std::filesystem::path program;  ///< the talus that computes the points; empty: this one
  /// Of the values of the sweep, every `parts`-th from `part` (from 0) is run here, with all methods; several machines
  /// share a study that way.
  int part = 0;
  int parts = 1;
  bool page_only = false;  ///< makes tables and page from the points that are there
};

/// Runs what is missing of a study and writes study.json, study.csv and index.html into its folder.
/// @return interrupted where a stop was requested; the points done so far are kept, and the next call goes on
/// from there
core::ExitCode run_study(const StudyRequest& request);

}  // namespace talus::study
