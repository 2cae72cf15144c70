#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "coupler/barrier/channel_filter.hpp"
#include "coupler/barrier/rules.hpp"

using namespace talus::barrier;
using nlohmann::json;

namespace {

constexpr double interval = 1e-4;  // s

std::vector<double> wave(double frequency) {
  std::vector<double> samples;
  for (int i = 0; i < 10000; ++i)
    samples.push_back(std::sin(2 * std::numbers::pi * frequency * interval * i));
  return samples;
}

/// Away from the ends, where the filter starts and turns.
double amplitude(const std::vector<double>& samples) {
  return *std::max_element(samples.begin() + 3000, samples.end() - 3000);
}

/// An impact that keeps every rule.
json good() {
  return {{"finished", true},
          {"stopped", true},
          {"speed_m_per_s", 25.2},
          {"clearance_m", 0.4},
          {"broken", json::array()},
          {"energy_error", -1e-4},
          {"residual_share", 0.8},
          {"forces", json::array({{{"part", "upper"}, {"utilisation", 0.4}},
                                  {{"part", "brake"}, {"utilisation", nullptr}}})}};
}

BarrierSheet sheet() {
  BarrierSheet sheet;
  sheet.posts.count = 4;
  return sheet;
}

std::vector<json> that_fail(const json& test, const std::string& name = "mel") {
  std::vector<json> failed;
  for (const json& rule : rules_of({{name, test}}, sheet()))
    if (rule.at("passes") != true) failed.push_back(rule);
  return failed;
}

}  // namespace

TEST_CASE("a channel filter lets slow motion pass, damps fast motion and moves nothing in time") {
  // A Butterworth filter of second order leaves 1/sqrt(1 + (w/w_c)^4), run twice its square; in steps of T the frequencies
  // w are tan(pi f T). Of CFC 60 the corner (-3 dB) lies at 100 Hz (SAE J211).
  const auto warped = [](double frequency) { return std::tan(std::numbers::pi * frequency * interval); };
  const double corner = warped(2.0775 * 60);
  for (const double frequency : {5.0, 30.0, 60.0, 100.0, 400.0}) {
    CAPTURE(frequency);
    const double expected = 1 / (1 + std::pow(warped(frequency) / corner, 4));
    CHECK(amplitude(channel_filtered(wave(frequency), interval, 60)) == Approx(expected).epsilon(0.02));
  }
  CHECK(amplitude(channel_filtered(wave(100), interval, 60)) ==
        Approx(std::pow(10, -3.0 / 20)).epsilon(0.01));
  const auto slow = channel_filtered(wave(5), interval, 60);
  const auto peak = std::max_element(slow.begin() + 4000, slow.begin() + 6000) - slow.begin();
  CHECK(std::abs(peak - 4500) <= 2);  // a quarter of the wave's 2000 samples behind 4000
  const std::vector<double> steady(500, 7.0);
  for (const double value : channel_filtered(steady, interval, 180)) CHECK(value == Approx(7));
  CHECK(channel_filtered({}, interval, 60).empty());
}

TEST_CASE("classes and categories are those of the guideline") {
  CHECK(energy_class(99) == -1);
  CHECK(energy_class(100) == 0);
  CHECK(energy_class(0.5e-3 * 3200 * 25 * 25) == 3);  // 1000 kJ
  CHECK(energy_class(999) == 2);
  CHECK(energy_class(3000) == 6);
  CHECK(energy_class(4500) == 7);
  CHECK(energy_class(5000) == 8);
  CHECK(category(0.5) == "A");
  CHECK(category(0.49) == "B");
  CHECK(category(0.29) == "C");
}

TEST_CASE("each rule fails by the number that breaks it, and by no other") {
  CHECK(that_fail(good()).empty());
  const std::vector<std::pair<json, std::string>> broken{
      {{{"stopped", false}}, "stopped"},
      {{{"speed_m_per_s", 24.9}}, "speed"},
      {{{"clearance_m", -0.1}}, "ground"},
      {{{"broken", json::array({{{"part", "upper"}}})}}, "breaks"},
      {{{"energy_error", -0.03}}, "energy"},
      {{{"residual_share", 0.2}}, "height left"},
      {{{"forces", json::array({{{"part", "retaining_2w"}, {"utilisation", 1.01}}})}}, "retaining_2w"}};
  for (const auto& [change, words] : broken) {
    json test = good();
    test.update(change);
    const auto failed = that_fail(test);
    CAPTURE(words);
    REQUIRE(failed.size() == 1);
    CHECK(failed[0].at("passes") == false);
    CHECK(failed[0].at("what").get<std::string>().find(words) != std::string::npos);
  }
  json service = good();
  service["residual_share"] = 0.65;  // enough for a MEL, not for a SEL
  CHECK(that_fail(service).empty());
  CHECK(that_fail(service, "sel_1").size() == 2);  // the second impact is missing, too
}

TEST_CASE("what was not measured is not decided, and neither passes nor fails") {
  json test = good();
  for (const char* key : {"clearance_m", "energy_error", "residual_share", "speed_m_per_s"})
    test[key] = nullptr;
  test["forces"] = json::array();
  test["broken"] = nullptr;  // nothing can break: no rule, which could not fail
  const auto open = that_fail(test);
  CHECK(open.size() == 5);
  for (const json& rule : open) CHECK(rule.at("passes").is_null());
  const auto unfinished = that_fail({{"finished", false}});
  REQUIRE(unfinished.size() == 2);
  for (const json& rule : unfinished) CHECK(rule.at("passes").is_null());
}
