#pragma once

#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/output/result_writer.hpp"
#include "core/program/log.hpp"

/// What can still be said of a run whose files can perhaps not be written.
namespace talus::core {

/// What a summary says of a run from its start on: how it stands, and what was run.
nlohmann::json facts_of(const ResultWriter::Options& options, RunStatus status, const std::string& message);

/// As the text of a file; bytes that are no UTF-8, in a title or a path, are replaced.
std::string text_of(const nlohmann::json& summary);

/// A summary of these facts alone, of a run that failed before it had files.
void write_failed_summary(const ResultWriter::Options& options, const std::string& message) noexcept;

/// Does `write`; what it throws is a warning, because the first cause is what the user has to hear.
template <class Write>
void write_if_possible(Write&& write) noexcept {
  try {
    write();
  } catch (const std::exception& error) {
    log_warning(error.what());
  }
}

}  // namespace talus::core
