#include "coupler/explain/rules.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::explain {
namespace {

constexpr auto may_be_left_out = Finding::Kind::may_be_left_out;
constexpr auto seems_missing = Finding::Kind::seems_missing;

bool is_negligible(const ResultFacts& facts, const std::string& line) {
  return facts.largest(line) < negligible_energy * facts.impact();
}

std::string share(const ResultFacts& facts, const std::string& line) {
  return fmt::format("{:.2g} of the impact", facts.largest(line) / facts.impact());
}

bool nothing_turns(const ResultFacts& facts) {
  return is_negligible(facts, "particles.kinetic_rotation_J");
}

/// A line that an effect owns, whose energy stays negligible.
struct OwnedLine {
  const char* side;
  const char* effect;
  const char* line;
  const char* key;
};

std::vector<Finding> idle(const ResultFacts& facts, const OwnedLine& owned) {
  if (!facts.has(owned.side, owned.effect) || !is_negligible(facts, owned.line)) return {};
  return {{may_be_left_out, fmt::format("{}: its energy stays at {}: `{}` may be dropped", owned.effect,
                                        share(facts, owned.line), owned.key)}};
}

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  findings.insert(findings.end(), more.begin(), more.end());
}

}  // namespace

std::vector<Finding> friction_that_turns_nothing(const ResultFacts& facts) {
  if (!facts.has("particles", "friction") || !nothing_turns(facts) ||
      !is_negligible(facts, "contacts.friction_J"))
    return {};
  return {{may_be_left_out,
           fmt::format("rotation is integrated, but spin energy stays at {} and friction takes {}: "
                       "`friction` of `particles.contacts` may be dropped, and rotation with it",
                       share(facts, "particles.kinetic_rotation_J"), share(facts, "contacts.friction_J"))}};
}

std::vector<Finding> rolling_without_rotation(const ResultFacts& facts) {
  if (!facts.has("particles", "rolling resistance") || !nothing_turns(facts)) return {};
  return {{may_be_left_out,
           fmt::format("rolling resistance has nothing to resist, spin energy stays at {}: `rolling` of "
                       "`particles.contacts` may be dropped",
                       share(facts, "particles.kinetic_rotation_J"))}};
}

std::vector<Finding> gravity_that_does_no_work(const ResultFacts& facts) {
  std::vector<Finding> findings =
      idle(facts, {"structure", "gravity on the structure", "structure.gravity_J", "structure.gravity"});
  append(findings, idle(facts, {"particles", "gravity", "particles.gravity_J", "particles.gravity"}));
  return findings;
}

std::vector<Finding> damping_that_takes_nothing(const ResultFacts& facts) {
  std::vector<Finding> findings = idle(facts, {"structure", "mass-proportional damping",
                                               "structure.bulk_damping_J", "structure.damping.mass"});
  append(findings, idle(facts, {"structure", "stiffness-proportional damping", "structure.bulk_damping_J",
                                "structure.damping.stiffness"}));
  return findings;
}

std::vector<Finding> parts_that_never_dissipate(const ResultFacts& facts) {
  const std::string beginning = "structure.dissipated_";
  std::vector<Finding> findings;
  for (const auto& line : facts.lines(beginning)) {
    if (!is_negligible(facts, line)) continue;
    const std::string part = line.substr(beginning.size(), line.size() - beginning.size() - 2);  // "_J"
    findings.push_back(
        {may_be_left_out,
         fmt::format("`{}` dissipates {}: its friction, brake or yielding may be dropped; an elastic "
                     "rope gives the same",
                     part, share(facts, line))});
  }
  return findings;
}

std::vector<Finding> tension_fields_that_stay_taut(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& part : facts.parts)
    if (facts.has("structure", "tension field of " + part.name) && !part.ever_wrinkled)
      findings.push_back(
          {may_be_left_out, fmt::format("membrane `{}` stays taut in every frame: its `tension_field` "
                                        "may be dropped",
                                        part.name)});
  return findings;
}

std::vector<Finding> iterations_that_change_nothing(const ResultFacts& facts) {
  const double mean = facts.summary.value("/iterations/mean"_json_pointer, HUGE_VAL);
  if (mean > idle_iterations) return {};
  return {{may_be_left_out,
           fmt::format("the strong scheme takes {:.3g} iterations a window: `serial_explicit` gives the "
                       "same",
                       mean)}};
}

std::vector<Finding> compression_in_sheets(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& part : facts.parts) {
    if (part.kind != PartFacts::Kind::sheet || facts.has("structure", "tension field of " + part.name) ||
        part.compression <= negligible_compression * part.tension)
      continue;
    findings.push_back(
        {seems_missing, fmt::format("compression up to {:.2g} % of the tension in membrane `{}`: no "
                                    "tension field; `tension_field` lets it wrinkle instead",
                                    100 * part.compression / part.tension, part.name)});
  }
  return findings;
}

std::vector<Finding> compression_in_wires(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& part : facts.parts) {
    const bool is_post = part.compression > part.tension;
    if (part.kind != PartFacts::Kind::line || is_post ||
        part.compression <= negligible_compression * part.tension)
      continue;
    findings.push_back(
        {seems_missing,
         fmt::format("bars of `{}` push with up to {:.2g} % of their tension: if they are ropes or wires, "
                     "`cable` lets them go slack",
                     part.name, 100 * part.compression / part.tension)});
  }
  return findings;
}

std::vector<Finding> dashpots_too_fast_for_their_nodes(const ResultFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& limit : facts.summary.value("limits", nlohmann::json::array()))
    if (limit.at("name") == "contact dashpot on boundary nodes" && limit.value("exceeded", false))
      findings.push_back(
          {seems_missing,
           fmt::format("the step is {:.2g} times that which the contact dashpot on the structure's light "
                       "nodes can follow: `particles.implicit_contact` keeps its accuracy at this step",
                       limit.at("step_s").get<double>() / limit.at("limit_s").get<double>())});
  return findings;
}

std::vector<Finding> energy_made_by_the_coupling(const ResultFacts& facts) {
  if (facts.largest("interface.created_J") <= large_energy_error * facts.impact()) return {};
  return {{seems_missing,
           fmt::format("the coupling makes or loses {}: a smaller `coupling.window` or a strong scheme",
                       share(facts, "interface.created_J"))}};
}

std::vector<Finding> energy_that_does_not_close(const ResultFacts& facts) {
  const double error = facts.summary.at("energy").at("largest_error_relative").get<double>();
  if (std::abs(error) <= large_energy_error) return {};
  return {{seems_missing, fmt::format("the energy balance is off by {:.2g} % of the impact: a smaller step",
                                      100 * std::abs(error))}};
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      friction_that_turns_nothing,       rolling_without_rotation,    gravity_that_does_no_work,
      damping_that_takes_nothing,        parts_that_never_dissipate,  tension_fields_that_stay_taut,
      iterations_that_change_nothing,    compression_in_sheets,       compression_in_wires,
      dashpots_too_fast_for_their_nodes, energy_made_by_the_coupling, energy_that_does_not_close};
  return all;
}

}  // namespace talus::explain
