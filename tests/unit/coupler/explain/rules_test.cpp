#include "coupler/explain/rules.hpp"

#include <catch2/catch.hpp>

#include "coupler/explain/explain.hpp"

/// Every rule on both sides of its threshold, in a run whose impact has 1000 J.
namespace talus::explain {
namespace {

using nlohmann::json;

constexpr double impact = 1000;  // J
constexpr double below = 0.99, above = 1.01;

struct Line {
  std::string name;
  double joules = 0;
};

/// A result with these ledger lines beside the rock's kinetic energy, constant over two rows.
ResultFacts facts_with(const std::vector<Line>& lines) {
  ResultFacts facts;
  facts.summary = json::parse(R"({
    "last": {}, "wall_time_s": 2.0, "effects": [],
    "energy": {"kinds": {"particles.kinetic_J": "stored"}, "largest_error_relative": 0.0}})");
  facts.energy = {.names = {"time_s", "particles.kinetic_J"}, .columns = {{0, 1}, {impact, 0}}};
  for (const auto& line : lines) {
    facts.energy.names.push_back(line.name);
    facts.energy.columns.push_back({0, line.joules});
  }
  return facts;
}

void add_effect(ResultFacts& facts, const std::string& side, const std::string& name, bool present = true) {
  facts.summary["effects"].push_back(
      {{"side", side}, {"name", name}, {"present", present}, {"reason", "because"}});
}

/// Whether the rule finds something at this multiple of the threshold, with the effect in or out.
struct EnergyRule {
  Rule rule;
  const char* side;
  const char* effect;
  const char* line;
  bool finds(double multiple, bool present = true) const {
    ResultFacts facts = facts_with({{line, multiple * negligible_energy * impact}});
    add_effect(facts, side, effect, present);
    return !rule(facts).empty();
  }
};

PartFacts part(PartFacts::Kind kind, double compression) {
  return {.name = "net", .kind = kind, .tension = 500, .compression = compression * 500};
}

}  // namespace

TEST_CASE("an effect that is in may be left out where its energy is below a millionth of the impact's") {
  const EnergyRule rule = GENERATE(
      EnergyRule{rolling_without_rotation, "particles", "rolling resistance", "particles.kinetic_rotation_J"},
      EnergyRule{gravity_that_does_no_work, "particles", "gravity", "particles.gravity_J"},
      EnergyRule{gravity_that_does_no_work, "structure", "gravity on the structure", "structure.gravity_J"},
      EnergyRule{damping_that_takes_nothing, "structure", "mass-proportional damping",
                 "structure.bulk_damping_J"},
      EnergyRule{damping_that_takes_nothing, "structure", "stiffness-proportional damping",
                 "structure.bulk_damping_J"});
  CAPTURE(rule.effect);
  CHECK(rule.finds(below));
  CHECK_FALSE(rule.finds(above));
  CHECK_FALSE(rule.finds(-above));  // energies may be negative
  CHECK_FALSE(rule.finds(below, false));
}

TEST_CASE("friction may be left out only where neither spin nor friction takes energy") {
  const double threshold = negligible_energy * impact;
  const auto finds = [&](double spin, double friction, bool present = true) {
    ResultFacts facts = facts_with(
        {{"particles.kinetic_rotation_J", spin * threshold}, {"contacts.friction_J", friction * threshold}});
    add_effect(facts, "particles", "friction", present);
    return !friction_that_turns_nothing(facts).empty();
  };
  CHECK(finds(below, below));
  CHECK_FALSE(finds(above, below));
  CHECK_FALSE(finds(below, above));
  CHECK_FALSE(finds(below, below, false));
}

TEST_CASE("a part that can dissipate is named where it does not") {
  const double threshold = negligible_energy * impact;
  const auto found = parts_that_never_dissipate(facts_with(
      {{"structure.dissipated_upper_rope_J", below * threshold}, {"structure.dissipated_brake_J", 50}}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].text.starts_with("`upper_rope` dissipates 9.9e-07 of the impact"));
  CHECK(parts_that_never_dissipate(facts_with({{"structure.dissipated_rope_J", above * threshold}})).empty());
}

TEST_CASE("a tension field may be left out where the sheet is taut in every frame") {
  ResultFacts facts = facts_with({});
  facts.parts = {part(PartFacts::Kind::sheet, 0)};
  CHECK(tension_fields_that_stay_taut(facts).empty());  // there is none
  add_effect(facts, "structure", "tension field of net");
  CHECK(tension_fields_that_stay_taut(facts).size() == 1);
  facts.parts[0].ever_wrinkled = true;
  CHECK(tension_fields_that_stay_taut(facts).empty());
}

TEST_CASE("a strong scheme may be left out where it hardly iterates") {
  ResultFacts facts = facts_with({});
  CHECK(iterations_that_change_nothing(facts).empty());  // a weak scheme
  facts.summary["iterations"] = {{"mean", below * idle_iterations}};
  CHECK(iterations_that_change_nothing(facts).size() == 1);
  facts.summary["iterations"] = {{"mean", above * idle_iterations}};
  CHECK(iterations_that_change_nothing(facts).empty());
}

TEST_CASE("a sheet that is pressed misses a tension field, unless it has one") {
  ResultFacts facts = facts_with({});
  facts.parts = {part(PartFacts::Kind::sheet, below * negligible_compression)};
  CHECK(compression_in_sheets(facts).empty());
  facts.parts = {part(PartFacts::Kind::sheet, 0.12)};
  REQUIRE(compression_in_sheets(facts).size() == 1);
  CHECK(compression_in_sheets(facts)[0].text.starts_with(
      "compression up to 12 % of the tension in membrane `net`: no tension field"));
  facts.parts = {part(PartFacts::Kind::sheet, above * negligible_compression)};
  CHECK(compression_in_sheets(facts).size() == 1);
  add_effect(facts, "structure", "tension field of net");
  CHECK(compression_in_sheets(facts).empty());
}

TEST_CASE("bars that mostly pull and push a little miss their slackness; posts do not") {
  ResultFacts facts = facts_with({});
  const auto found_at = [&](double compression) {
    facts.parts = {part(PartFacts::Kind::line, compression)};
    return compression_in_wires(facts).size();
  };
  CHECK(found_at(below * negligible_compression) == 0);
  CHECK(found_at(above * negligible_compression) == 1);
  CHECK(found_at(0.99) == 1);
  CHECK(found_at(1.01) == 0);  // a post
}

TEST_CASE("a dashpot that outruns the nodes' masses misses implicit contact") {
  ResultFacts facts = facts_with({});
  const auto found_at = [&](double step) {
    facts.summary["limits"] = {{{"name", "contact dashpot on boundary nodes"},
                                {"limit_s", 1e-5},
                                {"step_s", step},
                                {"exceeded", step > 1e-5}}};
    return dashpots_too_fast_for_their_nodes(facts);
  };
  CHECK(found_at(below * 1e-5).empty());
  REQUIRE(found_at(5e-5).size() == 1);
  CHECK(found_at(5e-5)[0].text.starts_with("the step is 5 times"));
}

TEST_CASE("energy that the coupling makes, or that the balance misses, is told from a hundredth on") {
  const double threshold = large_energy_error * impact;
  CHECK(energy_made_by_the_coupling(facts_with({{"interface.created_J", -below * threshold}})).empty());
  CHECK(energy_made_by_the_coupling(facts_with({{"interface.created_J", -above * threshold}})).size() == 1);
  ResultFacts facts = facts_with({});
  facts.summary["energy"]["largest_error_relative"] = -below * large_energy_error;
  CHECK(energy_that_does_not_close(facts).empty());
  facts.summary["energy"]["largest_error_relative"] = -above * large_energy_error;
  CHECK(energy_that_does_not_close(facts).size() == 1);
}

TEST_CASE(
    "the explanation says every stage's share of the time, the largest first, and every line's energy") {
  ResultFacts facts = facts_with({{"contacts.damping_J", 250}});
  facts.summary["energy"]["kinds"]["contacts.damping_J"] = "dissipated";
  CHECK_THAT(explanation(facts), Catch::Contains("time: not measured"));
  facts.summary["last"] = {
      {"particles_time.motion_s", 0.5}, {"structure_time.elements_of_net_s", 1.0}, {"net.height_m", 9.0}};
  const std::string text = explanation(facts);
  const auto elements = text.find(" 50.0 %  structure  elements of net\n"),
             motion = text.find(" 25.0 %  particles  motion\n");
  CHECK(elements != std::string::npos);
  CHECK(motion != std::string::npos);
  CHECK(elements < motion);
  CHECK_THAT(text, Catch::Contains("      25 %           250 J  dissipated contacts.damping_J\n"));
  CHECK_THAT(text,
             Catch::Contains("may be left out\n  nothing found\nseems to be missing\n  nothing found\n"));
  CHECK_THAT(text, Catch::Contains("has no frames"));
}

}  // namespace talus::explain
