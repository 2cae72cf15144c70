#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/output/file.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "coupler/app/commands.hpp"
#include "coupler/barrier/scene_text.hpp"
#include "coupler/barrier/type_test.hpp"
#include "coupler/barrier/type_test_page.hpp"

namespace talus::coupler {

namespace {

struct BarrierRequest {
  std::filesystem::path sheet, out, test;
  std::vector<std::string> impacts{"sel", "mel"};
  double time_limit = 3600;  ///< s
  bool overwrite = false;
};

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += (all.empty() ? "" : "\n") + sentence;
  return all;
}

/// What an engineer would object to: warnings are logged, errors end it.
void look_at(const BarrierRequest& request, const barrier::LoadedSheet& loaded,
             const barrier::Layout& layout) {
  const barrier::Findings findings = barrier::findings_of(loaded.sheet, layout);
  for (const std::string& warning : findings.warnings)
    core::log_warning(fmt::format("{}: {}", request.sheet.string(), warning));
  if (!findings.errors.empty())
    throw core::ConfigError(fmt::format("{}: {}", request.sheet.string(), joined(findings.errors)));
}

core::ExitCode write_barrier(const BarrierRequest& request) {
  const barrier::LoadedSheet loaded = barrier::load_sheet(request.sheet);
  const barrier::Layout layout = barrier::layout_of(loaded.sheet);
  look_at(request, loaded, layout);
  const std::filesystem::path out = request.out.empty()
                                        ? std::filesystem::path(request.sheet.stem().string() + "_scene.yaml")
                                        : request.out;
  if (std::filesystem::exists(out) && !request.overwrite)
    throw core::ConfigError(
        fmt::format("{}: is there already; --overwrite replaces it, --out names another", out.string()));
  core::replace_file(out, barrier::scene_text(loaded, layout, request.sheet.filename().string()));
  fmt::print(
      "{}: {} posts, block of {:.4g} kg ({:.3f} m) at {:.4g} m/s, {:.4g} kJ; posts to retaining ropes {:.1f} "
      "deg\n",
      out.string(), layout.feet.size(), loaded.sheet.block.mass, layout.block_edge, loaded.sheet.block.speed,
      0.5e-3 * loaded.sheet.block.mass * loaded.sheet.block.speed * loaded.sheet.block.speed,
      layout.retaining_angle * 180 / std::numbers::pi);
  fmt::print("{}next: talus run {}\n", barrier::assumptions(loaded.sheet), out.string());
  return core::ExitCode::success;
}

/// A number of a test as people say it, or "-".
std::string said(const nlohmann::json& value, const char* unit, double factor = 1) {
  return value.is_number() ? fmt::format("{:.3g} {}", factor * value.get<double>(), unit) : "-";
}

void print_verdict(const nlohmann::json& report) {
  fmt::print("\n{:<30} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "", "elongation", "braking time", "height left",
             "most used", "energy error");
  for (const auto& test : report.at("tests")) {
    if (!test.at("finished").get<bool>()) {
      fmt::print("{:<30} did not finish: {}\n", test.at("title").get<std::string>(),
                 test.at("why_not").get<std::string>());
      continue;
    }
    double used = 0;
    for (const auto& row : test.at("forces"))
      if (row.at("utilisation").is_number()) used = std::max(used, row.at("utilisation").get<double>());
    fmt::print("{:<30} {:>12} {:>12} {:>12} {:>12} {:>12}\n", test.at("title").get<std::string>(),
               said(test.at("largest_elongation_m"), "m"), said(test.at("braking_time_s"), "s"),
               said(test.at("residual_share"), "%", 100), fmt::format("{:.0f} %", 100 * used),
               said(test.at("energy_error"), "%", 100));
  }
  int failed = 0, open = 0;
  for (const auto& rule : report.at("rules")) {
    if (rule.at("passes").is_null()) ++open;
    if (rule.at("passes") == false) {
      ++failed;
      fmt::print("fails  {}: {} ({}{}; asked for: {})\n", rule.at("test").get<std::string>(),
                 rule.at("what").get<std::string>(), rule.at("value").dump(),
                 rule.at("unit").get<std::string>().empty() ? "" : " " + rule.at("unit").get<std::string>(),
                 rule.at("limit").get<std::string>());
    }
  }
  fmt::print("{} rules, {} failed, {} not decided\n", report.at("rules").size(), failed, open);
}

core::ExitCode test_barrier(const BarrierRequest& request) {
  const barrier::LoadedSheet loaded = barrier::load_sheet(request.sheet);
  look_at(request, loaded, barrier::layout_of(loaded.sheet));
  if (std::filesystem::exists(request.test / "report.json") && !request.overwrite)
    throw core::ConfigError(
        fmt::format("{}: holds a test already; --overwrite replaces it", request.test.string()));
  core::watch_stop_signals("with the stage in progress");
  const auto report =
      barrier::run_type_test({.loaded = loaded,
                              .sheet_file = request.sheet.filename().string(),
                              .folder = std::filesystem::absolute(request.test),
                              .impacts = {request.impacts.begin(), request.impacts.end()},
                              .time_limit = request.time_limit,
                              .tell = [](const std::string& line) { fmt::print(stderr, "{}\n", line); }});
  if (!report) {
    fmt::print(stderr, "{}; the stages that finished stay in {}\n", core::stop_reason(),
               request.test.string());
    return core::ExitCode::interrupted;
  }
  barrier::write_type_test_report(request.test, *report);
  print_verdict(*report);
  fmt::print("{}\n", (request.test / "report.html").string());
  return core::ExitCode::success;
}

core::ExitCode print_sheet_schema() {
  fmt::print("{}", barrier::sheet_schema());
  return core::ExitCode::success;
}

}  // namespace

void add_barrier(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("barrier", "write the scene of a rockfall barrier from its data sheet");
  command->footer(
      "Examples:\n  talus barrier configs/sheets/d1000.yaml --out d1000.yaml && talus run d1000.yaml\n"
      "  talus barrier configs/sheets/d1000.yaml --test results/d1000");
  const auto request = std::make_shared<BarrierRequest>();
  auto* sheet = command->add_option("SHEET", request->sheet, "the data sheet, a YAML file");
  const auto schema = std::make_shared<bool>(false);
  command->add_flag("--schema", *schema, "print the keys of a data sheet as Markdown")->excludes(sheet);
  command->add_option("--out", request->out, "the scene (default: <name of the sheet>_scene.yaml, here)");
  auto* test = command->add_option(
      "--test", request->test,
      "run the type test: settle, two SEL without repair, MEL; this folder takes stages and report");
  test->excludes("--out");
  command->add_option("--impacts", request->impacts, "of the test: sel, mel (default: both)")
      ->delimiter(',')
      ->check(CLI::IsMember({"sel", "mel"}))
      ->needs(test);
  command->add_option("--time-limit", request->time_limit, "s; of every stage (default 3600)")
      ->check(CLI::PositiveNumber)
      ->needs(test);
  command->add_flag("--overwrite", request->overwrite, "replace a scene or a test that is there");
  command->callback([request, sheet, schema, &chosen] {
    if (*schema) {
      chosen.run = print_sheet_schema;
      return;
    }
    if (sheet->count() == 0) throw CLI::RequiredError("SHEET");
    chosen.run = [request] {
      return request->test.empty() ? write_barrier(*request) : test_barrier(*request);
    };
  });
}

}  // namespace talus::coupler
