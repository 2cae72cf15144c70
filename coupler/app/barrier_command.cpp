#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <numbers>

#include "core/output/file.hpp"
#include "core/program/log.hpp"
#include "coupler/app/commands.hpp"
#include "coupler/barrier/scene_text.hpp"

namespace talus::coupler {

namespace {

struct BarrierRequest {
  std::filesystem::path sheet, out;
  bool overwrite = false;
};

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += (all.empty() ? "" : "\n") + sentence;
  return all;
}

core::ExitCode write_barrier(const BarrierRequest& request) {
  const barrier::LoadedSheet loaded = barrier::load_sheet(request.sheet);
  const barrier::Layout layout = barrier::layout_of(loaded.sheet);
  const barrier::Findings findings = barrier::findings_of(loaded.sheet, layout);
  for (const std::string& warning : findings.warnings)
    core::log_warning(fmt::format("{}: {}", request.sheet.string(), warning));
  if (!findings.errors.empty())
    throw core::ConfigError(fmt::format("{}: {}", request.sheet.string(), joined(findings.errors)));
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

core::ExitCode print_sheet_schema() {
  fmt::print("{}", barrier::sheet_schema());
  return core::ExitCode::success;
}

}  // namespace

void add_barrier(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("barrier", "write the scene of a rockfall barrier from its data sheet");
  command->footer(
      "Example:\n  talus barrier configs/sheets/d1000.yaml --out d1000.yaml && talus run d1000.yaml");
  const auto request = std::make_shared<BarrierRequest>();
  auto* sheet = command->add_option("SHEET", request->sheet, "the data sheet, a YAML file");
  const auto schema = std::make_shared<bool>(false);
  command->add_flag("--schema", *schema, "print the keys of a data sheet as Markdown")->excludes(sheet);
  command->add_option("--out", request->out, "the scene (default: <name of the sheet>_scene.yaml, here)");
  command->add_flag("--overwrite", request->overwrite, "replace a scene that is there");
  command->callback([request, sheet, schema, &chosen] {
    if (*schema) {
      chosen.run = print_sheet_schema;
      return;
    }
    if (sheet->count() == 0) throw CLI::RequiredError("SHEET");
    chosen.run = [request] { return write_barrier(*request); };
  });
}

}  // namespace talus::coupler
