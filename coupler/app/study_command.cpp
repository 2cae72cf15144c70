#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "coupler/app/commands.hpp"
#include "coupler/study/study.hpp"
#include "coupler/study/study_scene.hpp"

namespace talus::coupler {
namespace {

/// "3/10" as the third of ten.
void set_part(study::StudyRequest& request, const std::string& text) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d/%d%c", &request.part, &request.parts, &rest) != 2)
    throw CLI::ValidationError("--part", "wants I/N, such as 3/10");
  --request.part;
}

core::ExitCode print_study_schema() {
  fmt::print("{}", study::study_schema());
  return core::ExitCode::success;
}

}  // namespace

void add_study(CLI::App& app, Chosen& chosen) {
  auto* command =
      app.add_subcommand("study", "measure what accuracy costs in time: a scene over steps and methods");
  command->footer("Example:\n  talus study configs/studies/cable_net_step.yaml");
  const auto request = std::make_shared<study::StudyRequest>();
  auto* study = command->add_option("STUDY", request->study, "the study, a YAML file");
  const auto schema = std::make_shared<bool>(false);
  command->add_flag("--schema", *schema, "print the keys of a study as Markdown")->excludes(study);
  command->add_option("--out", request->out, "folder of the study (default: results/<name of the study>)");
  command->add_option_function<std::string>(
      "--part", [request](const std::string& text) { set_part(*request, text); },
      "run only the I-th of N shares of the points, for several machines at once");
  command->add_flag("--page-only", request->page_only,
                    "run nothing; make tables and page from the points that are there");
  command->callback([request, study, schema, &chosen] {
    if (*schema) {
      chosen.run = print_study_schema;
      return;
    }
    if (study->count() == 0) throw CLI::RequiredError("STUDY");
    chosen.run = [request] { return study::run_study(*request); };
  });
}

}  // namespace talus::coupler
