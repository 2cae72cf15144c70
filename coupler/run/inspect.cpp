#include "coupler/run/inspect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "core/scene/reader.hpp"
#include "coupler/launch/find_solver.hpp"
#include "coupler/regress/regression.hpp"
#include "coupler/run/prepared_run.hpp"

namespace talus::coupler {
namespace {

/// What a program prints on its standard output. @throws TransportError where it ends badly
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer{};
  while (pipe != nullptr) {
    const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe.get());
    text.append(buffer.data(), count);
    if (count < buffer.size()) break;
  }
  if (text.empty()) {
    throw core::TransportError({.peer = command, .waited_for = "its schema", .reason = "printed nothing"});
  }
  return text;
}

template <class Section>
std::string markdown_of(const char* section, const char* help) {
  Section value;
  return core::schema_markdown(section, help, [&](core::Fields& fields) { describe(fields, value); });
}

void print_tightest(const std::vector<CheckedLimit>& limits, bool stability) {
  const auto found = std::find_if(limits.begin(), limits.end(),
                                  [=](const auto& l) { return l.limit.stability == stability; });
  const char* kind = stability ? "stability" : "accuracy";
  if (found == limits.end()) {
    fmt::print("no {} limit\n", kind);
  } else {
    fmt::print("tightest {} limit: {}\n", kind, found->text());
  }
}

/// @param what "limits"
void print_not_asked(const PreparedRun& run, const char* what) {
  for (const NotAsked& side : run.not_asked)
    fmt::print(
        "The {0} was not asked: the scene names a program for it, {1}. Its {2}, and those of what the other "
        "side does with it, are missing here; --trust starts the program and asks it.\n",
        name_of(side.role), side.program.string(), what);
}

}  // namespace

core::ExitCode check_scene(const InspectRequest& request) {
  PreparedRun run = prepare({.scene = request.scene, .trust = request.trust});
  run.session->finish();
  fmt::print("{}\n", table_of(run.limits));
  print_tightest(run.limits, true);
  print_tightest(run.limits, false);
  print_not_asked(run, "limits");
  const bool refused =
      std::any_of(run.limits.begin(), run.limits.end(), [](const auto& l) { return l.refused(); });
  return refused ? core::ExitCode::config : core::ExitCode::success;
}

core::ExitCode explain_scene(const InspectRequest& request) {
  PreparedRun run = prepare({.scene = request.scene, .trust = request.trust});
  run.session->finish();
  for (Peer* peer : run.session->peers()) {
    fmt::print("{} ({})\n", name_of(peer->role()), peer->declaration().program);
    for (const auto& effect : peer->declaration().effects) {
      fmt::print("  {:<3} {:<32} {}\n", effect.present ? "in" : "out", effect.name, effect.reason);
    }
  }
  print_not_asked(run, "effects");
  return core::ExitCode::success;
}

core::ExitCode print_schema() {
  std::string page = "# Keys of a scene\n\nPrinted by `talus schema`.\n\n";
  page += markdown_of<core::TimeScene>("time", "the span of the run");
  page += markdown_of<core::OutputScene>("output", "what is written and how often");
  page += markdown_of<InterfaceScene>("interface",
                                      "what the particles touch and how it moves with the structure");
  page +=
      markdown_of<CouplingScene>("coupling", "how often and in which order the two sides hear of each other");
  page += markdown_of<regress::RegressionScene>(
      "regression", "how far the result may be from its baseline (talus regress)");
  for (const char* solver : {"fem_solver", "dem_solver"}) {
    page += output_of("'" + launch::own_solver(solver).string() + "' --schema");
  }
  fmt::print("{}", page);
  return core::ExitCode::success;
}

}  // namespace talus::coupler
