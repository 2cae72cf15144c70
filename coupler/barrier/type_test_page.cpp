#include "coupler/barrier/type_test_page.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/output/file.hpp"
#include "coupler/page/page.hpp"
#include "coupler/report/replay.hpp"
#include "coupler/report/report.hpp"

namespace talus::barrier {

extern const char* const sizes_script;
extern const char* const verdict_script;
extern const char* const svg_script;
extern const char* const curves_script;
extern const char* const drawing_script;
extern const char* const type_test_page_template;

namespace {

std::string page_body() {
  std::string body = report::replay_scripts();
  for (const char* script : {sizes_script, verdict_script, svg_script, curves_script, drawing_script})
    body += std::string("<script>\n") + script + "</script>\n";
  return body + type_test_page_template;
}

}  // namespace

void write_type_test_report(const std::filesystem::path& folder, const nlohmann::json& report) {
  core::replace_file(folder / "report.json", report.dump(1));
  nlohmann::json data = report;
  data["replays"] = nlohmann::json::object();
  const auto share =
      report::replay_budget / std::max<std::int64_t>(1, static_cast<std::int64_t>(report.at("tests").size()));
  for (const auto& test : report.at("tests"))
    if (test.value("finished", false)) {
      const auto name = test.at("name").get<std::string>();
      data["replays"][name] = report::replay(folder / name / "fields.h5", share);
    }
  core::replace_file(folder / "report.html",
                     page::make(page_body(), report.value("title", "Type test"), data));
}

}  // namespace talus::barrier
