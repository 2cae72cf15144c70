#include "core/units/units.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>
#include <vector>

namespace talus {
namespace {

double value(double number, const std::string& unit, const std::string& wanted) {
  const auto result = core::convert({number, unit}, wanted);
  REQUIRE(result.outcome == core::UnitConversion::Outcome::ok);
  return result.value;
}
core::UnitConversion::Outcome outcome(const std::string& unit, const std::string& wanted) {
  return core::convert({1, unit}, wanted).outcome;
}
using Outcome = core::UnitConversion::Outcome;

// Definitions: international inch 25.4 mm, avoirdupois pound 0.45359237 kg, standard gravity 9.80665 m/s^2
// (NIST SP 811, appendix B).
constexpr double inch = 0.0254, pound_force = 0.45359237 * 9.80665;

}  // namespace

TEST_CASE("units of the trade convert to SI by their definitions") {
  CHECK(value(4, "mm", "m") == 4e-3);
  CHECK(value(1770, "N/mm^2", "Pa") == 1.77e9);
  CHECK(value(20, "1/s", "1/s") == 20);
  CHECK(value(45, "deg", "rad") == Approx(std::acos(-1.0) / 4).epsilon(1e-14));
  CHECK(value(2.5, "t", "kg") == 2500);
  CHECK(value(90, "km/h", "m/s") == Approx(25).epsilon(1e-15));
  CHECK(value(1, "kN/m", "N/m") == 1000);
  CHECK(value(8, "kip", "N") == Approx(8000 * pound_force).epsilon(1e-13));
  CHECK(value(19000, "ksi", "Pa") == Approx(19e6 * pound_force / (inch * inch)).epsilon(1e-13));
  CHECK(value(3.16, "lb/ft", "kg/m") == Approx(3.16 * 0.45359237 / 0.3048).epsilon(1e-13));
  CHECK(value(1, "rpm", "rad/s") == Approx(2 * std::acos(-1.0) / 60).epsilon(1e-13));
}

TEST_CASE("decimal prefixes give the double nearest to the decimal number") {
  CHECK(value(50, "us", "s") == 50e-6);
  CHECK(value(0.5, "ms", "s") == 0.5e-3);
  CHECK(value(12.56637061, "mm^2", "m^2") == 12.56637061e-6);
  CHECK(value(210, "GPa", "Pa") == 210e9);
}

TEST_CASE("a unit of another dimension, an unknown one and an offset one are told apart from good ones") {
  CHECK(outcome("kg", "m") == Outcome::other_dimension);
  CHECK(outcome("m", "") == Outcome::other_dimension);
  CHECK(outcome("smoot", "m") == Outcome::unknown_unit);
  CHECK(outcome("degC", "K") == Outcome::unknown_unit);
  CHECK(outcome("m from 3", "m") == Outcome::unknown_unit);
  CHECK(outcome("20 m", "m") == Outcome::unknown_unit);
  CHECK(outcome("m 20", "m") == Outcome::unknown_unit);
}

TEST_CASE("angles, angular velocities, frequencies and plain numbers never turn into each other") {
  const std::vector<std::string> angles{"rad", "deg", "arcmin", "turn", "mrad"};
  const std::vector<std::string> spins{"rad/s", "rpm", "turn/s", "rev/s", "deg/min"};
  const std::vector<std::string> rates{"Hz", "1/s", "kHz", "1/min"};
  const std::vector<std::string> numbers{"1", "%", "mm/m"};
  const auto refused = [](const std::vector<std::string>& units, const std::vector<const char*>& wanted) {
    for (const auto& unit : units)
      for (const char* other : wanted) {
        INFO(unit << " for " << other);
        CHECK(outcome(unit == "1" ? "" : unit, other) == Outcome::other_dimension);
      }
  };
  refused(angles, {"", "rad/s", "1/s", "m"});
  refused(spins, {"", "rad", "1/s"});
  refused(rates, {"", "rad", "rad/s"});
  refused(numbers, {"rad", "rad/s", "1/s"});
  for (const auto& unit : angles) CHECK(outcome(unit, "rad") == Outcome::ok);
  for (const auto& unit : spins) CHECK(outcome(unit, "rad/s") == Outcome::ok);
  for (const auto& unit : rates) CHECK(outcome(unit, "1/s") == Outcome::ok);
  CHECK(value(3, "turn/s", "rad/s") == Approx(6 * std::acos(-1.0)).epsilon(1e-14));
}

TEST_CASE("a time is no rate, although UDUNITS would take its inverse") {
  CHECK(outcome("s", "1/s") == Outcome::other_dimension);
  CHECK(outcome("Hz", "s") == Outcome::other_dimension);
}

TEST_CASE("a value of the wrong kind is told what it is and what to write") {
  CHECK(core::other_kind({30, "deg"}, "") == "an angle; its tangent is 0.57735");
  CHECK(core::other_kind({3, "Hz"}, "rad/s") ==
        "a frequency; where turns are meant, write '3 turn/s' or '18.8496 rad/s'");
  CHECK(core::other_kind({3, "rpm"}, "1/s") == "an angular velocity");
  CHECK(core::other_kind({20, "%"}, "rad") == "a number");
  for (const char* unit : {"kg", "sr", "smoot", "rad"}) CHECK(core::other_kind({1, unit}, "rad").empty());
}

TEST_CASE("several threads may convert at the same time") {
  std::vector<double> found(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] { found[i] = core::convert({1, i % 2 ? "mm" : "in"}, "m").value; });
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK(found[i] == Approx(i % 2 ? 1e-3 : inch).epsilon(1e-15));
}

TEST_CASE("a quantity is a number with or without a unit, and nothing else") {
  CHECK(core::parse_quantity("50 us", "s") == 50e-6);
  CHECK(core::parse_quantity("0.2", "s") == 0.2);
  CHECK(core::parse_quantity("4mm", "m") == 4e-3);
  for (const char* text : {"", "us", "50 kg", "nan", "1 2 s"}) CHECK_FALSE(core::parse_quantity(text, "s"));
}

TEST_CASE("quantities print with the prefix that keeps them short") {
  CHECK(core::readable(5e-5, "s") == "50 us");
  CHECK(core::readable(0.0125, "m") == "12.5 mm");
  CHECK(core::readable(1.77e9, "Pa") == "1.77 GPa");
  CHECK(core::readable(-2500, "N") == "-2.5 kN");
  CHECK(core::readable(1500, "m") == "1500 m");
  CHECK(core::readable(0, "m") == "0 m");
  CHECK(core::readable(0.25, "") == "0.25");
  CHECK(core::readable(20, "1/s") == "20 1/s");
}

}  // namespace talus
