#include "coupler/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/program/log.hpp"
#include "core/steps.hpp"
#include "core/units/units.hpp"

namespace talus::coupler {
namespace {

using nlohmann::json;

json to_json(const CheckedLimit& limit) {
  return {{"side", limit.side},
          {"name", limit.limit.name},
          {"limit_s", limit.limit.seconds},
          {"step_s", limit.step},
          {"kind", limit.limit.stability ? "stability" : "accuracy"},
          {"exceeded", limit.exceeded()},
          {"reason", limit.limit.reason}};
}

json to_json(const Effect& effect, const std::string& side) {
  return {{"side", side},
          {"name", effect.name},
          {"present", effect.present},
          {"reason", effect.reason},
          {"key", effect.key},
          {"ledger_line", effect.ledger_line},
          {"may_hold", effect.may_hold},
          {"limit", effect.limit}};
}

json to_json(const Interface& interface) {
  return {{"structure_nodes", interface.structure.node_count()},
          {"boundary_nodes", interface.boundary.node_count()},
          {"largest_distance_m", interface.tie.largest_distance},
          {"tolerance_m", interface.tie.tolerance}};
}

/// s; that a side really takes.
double step_of(const Declaration& side, double window) {
  return side.step > 0 ? core::equal_steps(window, std::min(side.step, window)).length : window;
}

/// Where windows were not all of one length.
std::string words_about_windows(const json& summary) {
  std::string words;
  if (const auto flight = summary.find("free_flight"); flight != summary.end())
    words += fmt::format(
        "  free flight      {} windows in place of {}, {} taken back, the longest {}\n",
        flight->at("windows").get<std::int64_t>(),
        flight->at("windows").get<std::int64_t>() + flight->at("regular_windows_spared").get<std::int64_t>(),
        flight->at("windows_taken_back").get<std::int64_t>(),
        core::readable(flight->at("longest_window_s").get<double>(), "s"));
  const auto iterations = summary.find("iterations");
  if (iterations != summary.end() && iterations->at("windows_halved") > 0)
    words += fmt::format("  halved windows   {}, the shortest {}\n",
                         iterations->at("windows_halved").get<std::int64_t>(),
                         core::readable(iterations->at("shortest_window_s").get<double>(), "s"));
  return words;
}

/// How near the structure came to breaking, and what did break.
std::string words_about_strength(const json& tables) {
  std::string words;
  if (const auto used = tables.find("utilisation"); used != tables.end()) {
    std::pair<double, std::string> most;
    for (const auto& [part, row] : used->items())
      most = std::max(most, {row.at("utilisation").get<double>(), part});
    words +=
        fmt::format("  most used        {}: {:.0f} % of its breaking load\n", most.second, 100 * most.first);
  }
  if (const auto pressed = tables.find("buckling"); pressed != tables.end())
    for (const auto& [part, row] : pressed->items())
      if (row.at("utilisation") >= 1)
        words += fmt::format("  would buckle     {}: {:.0f} % of the load at which a hinged one does\n", part,
                             100 * row.at("utilisation").get<double>());
  if (const auto ruptures = tables.find("ruptures"); ruptures != tables.end())
    for (const auto& [part, row] : ruptures->items())
      if (row.at("broken") > 0)
        words += fmt::format("  broken           {:.0f} elements of {}, the first at {} under {}\n",
                             row.at("broken").get<double>(), part,
                             core::readable(row.at("first_time_s").get<double>(), "s"),
                             core::readable(row.at("first_force_N").get<double>(), "N"));
  return words;
}

}  // namespace

void add_facts(json& summary, const PreparedRun& run) {
  summary["window_s"] = run.window_length();
  if (run.interface) summary["scheme"] = name_of(run.scene.coupling.scheme);
  summary["limited_by"] = tightest_name(run.limits);
  summary["limits"] = summary["effects"] = json::array();
  for (const auto& limit : run.limits) summary["limits"].push_back(to_json(limit));
  for (Peer* peer : run.session->peers()) {
    summary["participants"][name_of(peer->role())] = peer->declaration().program;
    summary["step_s"][name_of(peer->role())] = step_of(peer->declaration(), run.window_length());
    for (const auto& effect : peer->declaration().effects)
      summary["effects"].push_back(to_json(effect, name_of(peer->role())));
  }
  if (run.interface) summary["interface"] = to_json(*run.interface);
}

void add_work(json& summary, Session& session) {
  json& work = summary["work"] = json::object();
  for (const Peer* peer : session.peers()) {
    const std::string side = name_of(peer->role());
    work[side + "_calls"] = peer->calls();
    if (peer->force_evaluations() > 0) work[side + "_force_evaluations"] = peer->force_evaluations();
  }
}

void add_iterations(json& summary, const IterationTally& tally, double window_length) {
  const auto windows = static_cast<double>(std::max<std::int64_t>(tally.windows, 1));
  summary["iterations"] = {
      {"mean", static_cast<double>(tally.iterations) / windows},
      {"most", tally.most},
      {"total", tally.iterations},
      {"windows", tally.windows},
      {"in_contact", {{"windows", tally.in_contact}, {"most", tally.most_in_contact}}},
      {"windows_not_converged", tally.not_converged},
      {"windows_halved", tally.halved},
      {"shortest_window_s", std::ldexp(window_length, -static_cast<int>(tally.most_halvings))}};
  if (tally.not_converged == 0) return;
  core::log_warning(fmt::format("{} of {} windows did not converge", tally.not_converged, tally.windows));
}

void add_flight(json& summary, const FlightTally& tally, double window_length) {
  summary["free_flight"] = {{"windows", tally.windows},
                            {"regular_windows_spared", tally.regular - tally.windows},
                            {"windows_taken_back", tally.taken_back},
                            {"longest_window_s", window_length * static_cast<double>(tally.longest)}};
}

std::string closing_words(const std::filesystem::path& folder) {
  const json summary = json::parse(std::ifstream(folder / "summary.json"));
  std::string words = summary.at("status").get<std::string>() + "\n";
  for (const auto& [name, peak] : summary.at("peaks").items()) {
    words += fmt::format("  peak {:<36} {:>13.6g} at {}\n", name, peak.at("value").get<double>(),
                         core::readable(peak.at("time_s").get<double>(), "s"));
  }
  words += fmt::format("  energy error     {:.3g} of the largest kinetic energy\n",
                       summary.at("energy").at("error_relative").get<double>());
  words += fmt::format("  real-time factor {:.3g} ({} simulated in {})\n",
                       summary.at("real_time_factor").get<double>(),
                       core::readable(summary.at("simulated_time_s").get<double>(), "s"),
                       core::readable(summary.at("wall_time_s").get<double>(), "s"));
  words += words_about_windows(summary) + words_about_strength(summary.at("tables"));
  const auto limited_by = summary.at("limited_by").get<std::string>();
  if (!limited_by.empty()) words += "  step limited by  " + limited_by + "\n";
  for (const auto& warning : summary.at("warnings"))
    words += "  warning: " + warning.get<std::string>() + "\n";
  return words + "  files in         " + folder.string();
}

}  // namespace talus::coupler
