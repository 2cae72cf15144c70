#include "core/output/last_words.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "core/output/file.hpp"

namespace talus::core {
namespace {

const char* name_of(RunStatus status) {
  static constexpr std::array names{"running", "finished", "interrupted", "failed"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace

nlohmann::json facts_of(const ResultWriter::Options& options, RunStatus status, const std::string& message) {
  nlohmann::json json{{"status", name_of(status)},
                      {"title", options.title},
                      {"scene", options.scene.string()},
                      {"scene_hash", options.scene_hash},
                      {"program", options.program}};
  if (!message.empty()) json["message"] = message;
  return json;
}

std::string text_of(const nlohmann::json& summary) {
  constexpr int indentation = 2;
  return summary.dump(indentation, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_failed_summary(const ResultWriter::Options& options, const std::string& message) noexcept {
  write_if_possible([&] {
    replace_file(options.folder / "summary.json", text_of(facts_of(options, RunStatus::failed, message)));
  });
}

}  // namespace talus::core
