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
  facts.summary["energy"]["impact_J"] = impact;
  facts.energy = {.names = {"time_s", "particles.kinetic_J"}, .columns = {{0, 1}, {impact, 0}}};
  for (const auto& line : lines) {
    facts.energy.names.push_back(line.name);
    facts.energy.columns.push_back({0, line.joules});
  }
  return facts;
}

/// Of a program nobody has heard of: rules know what it declares, not its names.
EffectFacts own_effect(bool present = true) {
  return {.side = "third",
          .name = "wind",
          .key = "third.wind",
          .ledger_line = "third.wind_J",
          .limit = {},
          .present = present};
}

bool may_go(const EffectFacts& effect, double joules) {
  ResultFacts facts = facts_with({{"third.wind_J", joules}});
  facts.effects = {effect};
  return !effects_that_do_nothing(facts).empty();
}

PartFacts part(PartFacts::Kind kind, double compression) {
  return {.name = "net",
          .kind = kind,
          .tension = 500,
          .compression = compression * 500,
          .frames = telling_frames};
}

/// An effect that takes the compression of `part` away.
EffectFacts against_compression(bool present) {
  return {.side = "third",
          .name = "folding",
          .key = "third.fold",
          .ledger_line = {},
          .limit = "compression of net",
          .present = present};
}

}  // namespace

TEST_CASE(
    "an effect that is in may be left out where the energy it declares is below a millionth of the "
    "impact's") {
  const double threshold = negligible_energy * impact;
  CHECK(may_go(own_effect(), below * threshold));
  CHECK_FALSE(may_go(own_effect(), above * threshold));
  CHECK_FALSE(may_go(own_effect(), -above * threshold));  // energies may be negative
  CHECK_FALSE(may_go(own_effect(false), 0));
}

TEST_CASE("what may be left out is known by the key that names it, and all rules are asked") {
  ResultFacts facts = facts_with({{"third.wind_J", 0}});
  facts.effects = {own_effect()};
  const auto findings = findings_of(facts);
  REQUIRE(findings.size() == 1);
  CHECK(findings.front().key == "third.wind");
}

TEST_CASE("an effect that may hold without work may be left out only where its line stays at round-off") {
  EffectFacts friction = own_effect();
  friction.may_hold = true;
  CHECK(may_go(friction, 0));
  CHECK(may_go(friction, 1e-30 * impact));
  CHECK_FALSE(may_go(friction, 1e-20 * impact));
}

TEST_CASE("a line that is missing, or not declared, is unknown and not zero") {
  ResultFacts facts = facts_with({{"third.other_J", 0}});
  facts.effects = {own_effect()};
  CHECK(effects_that_do_nothing(facts).empty());
  facts.effects[0].ledger_line = "";
  CHECK(effects_that_do_nothing(facts).empty());
  CHECK(energy_made_by_the_coupling(facts).empty());
}

TEST_CASE("where nothing moves, no energy is small against an impact's") {
  ResultFacts facts = facts_with({{"third.wind_J", 0}});
  facts.summary["energy"]["impact_J"] = 0;
  facts.effects = {own_effect()};
  CHECK(effects_that_do_nothing(facts).empty());
}

TEST_CASE("an advice names the effect, the key that drops it, and what following it changes at most") {
  ResultFacts facts = facts_with({{"third.wind_J", 1e-4}});
  facts.effects = {own_effect()};
  REQUIRE(effects_that_do_nothing(facts).size() == 1);
  CHECK(effects_that_do_nothing(facts)[0].text ==
        "wind (`third.wind`): third.wind_J stays at 1e-07 of the impact; without it no peak changes by more "
        "than 0.1 %");
}

TEST_CASE(
    "what takes compression away may be left out where the part is seen to stay taut, in enough frames") {
  ResultFacts facts = facts_with({});
  facts.parts = {part(PartFacts::Kind::sheet, 0)};
  facts.parts[0].gave_way = false;
  CHECK(slackness_that_never_shows(facts).empty());  // there is none
  facts.effects = {against_compression(true)};
  CHECK(slackness_that_never_shows(facts).size() == 1);
  facts.parts[0].frames = telling_frames - 1;
  CHECK(slackness_that_never_shows(facts).empty());
  facts.parts[0].frames = telling_frames;
  facts.parts[0].gave_way = true;
  CHECK(slackness_that_never_shows(facts).empty());
  facts.parts[0].gave_way.reset();  // unknown
  CHECK(slackness_that_never_shows(facts).empty());
}

TEST_CASE("a strong scheme may be left out only where every window in contact took one iteration") {
  ResultFacts facts = facts_with({});
  CHECK(iterations_that_change_nothing(facts).empty());  // a weak scheme
  const auto found_with = [&](const json& iterations) {
    facts.summary["iterations"] = iterations;
    return iterations_that_change_nothing(facts).size();
  };
  const json all_at_once{{"mean", 1.0},
                         {"windows_halved", 0},
                         {"windows_not_converged", 0},
                         {"in_contact", {{"windows", 30}, {"most", 1}}}};
  CHECK(found_with(all_at_once) == 1);
  json other = all_at_once;
  other["in_contact"]["most"] = 4;  // though the mean over free flight is 1.002
  CHECK(found_with(other) == 0);
  other = all_at_once;
  other["in_contact"]["windows"] = 0;  // nothing touched: nobody knows
  CHECK(found_with(other) == 0);
  other = all_at_once;
  other["windows_halved"] = 1;
  CHECK(found_with(other) == 0);
  CHECK(found_with({{"mean", 1.0}}) == 0);  // of a program that does not tell
}

TEST_CASE("a part that is pressed misses what takes compression away, unless it has it or nobody offers it") {
  ResultFacts facts = facts_with({});
  facts.effects = {against_compression(false)};
  facts.parts = {part(PartFacts::Kind::sheet, below * negligible_compression)};
  CHECK(compression_that_an_effect_takes_away(facts).empty());
  facts.parts = {part(PartFacts::Kind::sheet, 0.12)};
  REQUIRE(compression_that_an_effect_takes_away(facts).size() == 1);
  CHECK(
      compression_that_an_effect_takes_away(facts)[0].text ==
      "compression up to 12 % of the tension in `net`: folding (`third.fold`) is out and would take it away");
  facts.effects = {against_compression(true)};
  CHECK(compression_that_an_effect_takes_away(facts).empty());
  facts.effects = {};
  CHECK(compression_that_an_effect_takes_away(facts).empty());
}

TEST_CASE("lines that mostly pull and push a little miss their slackness; posts do not") {
  ResultFacts facts = facts_with({});
  facts.effects = {against_compression(false)};
  const auto found_at = [&](double compression) {
    facts.parts = {part(PartFacts::Kind::line, compression)};
    return compression_that_an_effect_takes_away(facts).size();
  };
  CHECK(found_at(below * negligible_compression) == 0);
  CHECK(found_at(above * negligible_compression) == 1);
  CHECK(found_at(0.99) == 1);
  CHECK(found_at(1.01) == 0);  // a post
}

TEST_CASE("a limit that is exceeded misses the effect that declares to lift it") {
  ResultFacts facts = facts_with({});
  EffectFacts effect = own_effect(false);
  effect.limit = "dashpots of the third";
  facts.effects = {effect};
  const auto found_at = [&](double step) {
    facts.summary["limits"] = {
        {{"name", "dashpots of the third"}, {"limit_s", 1e-5}, {"step_s", step}, {"exceeded", step > 1e-5}}};
    return limits_that_an_effect_lifts(facts);
  };
  CHECK(found_at(below * 1e-5).empty());
  REQUIRE(found_at(5e-5).size() == 1);
  CHECK(found_at(5e-5)[0].text ==
        "the step is 5 times the limit 'dashpots of the third': wind (`third.wind`) lifts it");
  facts.effects[0].present = true;
  CHECK(found_at(5e-5).empty());
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
