#include <catch2/catch.hpp>

#include "coupler/accuracy/clock.hpp"
#include "tests/unit/coupler/accuracy/fake_scene.hpp"

namespace talus {

using nlohmann::json;
using test::FakeScene;
using test::three_clocks;

namespace {

const json& peak(const json& bars) {
  return bars.at("peaks").at("net.z");
}

std::ptrdiff_t companions(const json& bars, const std::string& cause) {
  return std::ranges::count_if(bars.at("companions"),
                               [&](const json& one) { return one.at("cause") == cause; });
}

}  // namespace

TEST_CASE("every cause has the error that it has, and their sum holds the truth") {
  const FakeScene fake(std::string(three_clocks) + R"(
model:
  structure: {factor: 0.001, order: 2}
  particles: {factor: -0.01, order: 1}
  window: {factor: 0.0005, order: 2}
)");
  const json bars = fake.bars();
  const json& causes = peak(bars).at("causes");
  // The structure's 4 ms: 0.001 16; the particles' 2 ms: 0.01 2; the window's 8 ms: 0.0005 64; with the
  // factor of safety.
  CHECK(causes.at("step of the particles").at("above").get<double>() == Approx(1.25 * 0.02).epsilon(1e-6));
  CHECK(causes.at("window").at("above").get<double>() == Approx(1.25 * 0.032).epsilon(1e-6));
  CHECK(causes.at("window").at("order").get<double>() == Approx(2).epsilon(1e-6));
  // Twice the step is in the window, four times is not: one coarser and one finer companion.
  CHECK(causes.at("step of the structure").at("above").get<double>() == Approx(1.25 * 0.016).epsilon(1e-6));
  CHECK(peak(bars).at("kind") == "bar");
  CHECK(peak(bars).at("low").get<double>() < 3);
  CHECK(peak(bars).at("high").get<double>() > 3);
}

TEST_CASE("steps and window of one length cannot be told apart, and are one cause") {
  const FakeScene fake(R"(
time: {end: 1 s, step: 1 ms}
structure: {}
particles: {}
interface: {}
model: {particles: {factor: 0.1, order: 1}}
)");
  const json bars = fake.bars();
  const json& causes = peak(bars).at("causes");
  CHECK(causes.size() == 2);
  CHECK(causes.at("steps and window").at("above").get<double>() == Approx(1.25 * 0.1));
  CHECK(companions(bars, "steps and window") == 2);
}

TEST_CASE("a companion above a limit is not run: finer ones tell the error") {
  const std::string scene = R"(
time: {end: 1 s, step: 1 ms}
structure: {}
particles: {}
interface: {}
model: {particles: {factor: 0.1, order: 1}, limit: {structure: 1.5 ms}}
)";
  const json bars = FakeScene(scene).bars();
  for (const auto& one : bars.at("companions")) CHECK(one.at("size").get<double>() < 1);
  CHECK(companions(bars, "steps and window") == 2);
  CHECK(peak(bars).at("causes").at("steps and window").at("above").get<double>() == Approx(1.25 * 0.1));
}

TEST_CASE("a third run is spared where two differ by nothing that matters") {
  const json bars = FakeScene(R"(
time: {end: 1 s, step: 1 ms}
structure: {}
particles: {}
interface: {}
model: {particles: {factor: 1e-4, order: 1}, limit: {structure: 1.5 ms}}
)")
                        .bars();
  CHECK(companions(bars, "steps and window") == 1);
  CHECK(peak(bars).at("kind") == "bar");
}

TEST_CASE(
    "an order that is not the expected one gives a range with the truth in it, after half the step was "
    "tried") {
  const json bars = FakeScene(R"(
time: {end: 1 s, step: 1 ms}
structure: {}
particles: {}
interface: {}
model: {particles: {factor: 0.1, order: 0.5}}
)")
                        .bars();
  CHECK(peak(bars).at("kind") == "range");
  CHECK(companions(bars, "steps and window") == 4);
  CHECK(peak(bars).at("low").get<double>() < 3);
  CHECK(peak(bars).at("causes").at("steps and window").at("order").get<double>() ==
        Approx(0.5).epsilon(1e-6));
}

TEST_CASE(
    "a mesh that the scene names the size of is a cause, and so are the rows between which a peak may lie") {
  const json bars = FakeScene(R"(
time: {end: 1 s, step: 1 ms}
structure: {parts: {sheet: {sheet: {element_size: 0.2 m}}}}
particles: {}
interface: {}
model: {mesh: {factor: 0.5, order: 2}, rows: 0.04}
)")
                        .bars();
  const json& causes = peak(bars).at("causes");
  CHECK(causes.at("mesh of sheet").at("above").get<double>() == Approx(1.25 * 0.02));
  CHECK(causes.at("rows").at("above").get<double>() == Approx(0.01));
}

TEST_CASE("the cost of the companions stands beside that of the run") {
  const json bars = FakeScene(std::string(three_clocks) + "model: {window: {factor: 0.1, order: 2}}").bars();
  // 1/4 + 1/2 of a step of 1e-3 each.
  CHECK(bars.at("run_seconds").get<double>() == Approx(1e-3 / 4e-3 + 1e-3 / 2e-3));
  CHECK(bars.at("companions_seconds").get<double>() > 0);
  CHECK(bars.at("elapsed_seconds").get<double>() > 0);
}

TEST_CASE("a side's step keeps dividing the window, and its limit") {
  const accuracy::Clock clock{.window = 8e-3,
                              .sides = {{.name = "structure", .step = 4e-3, .largest = 1},
                                        {.name = "particles", .step = 8e-3, .largest = 1e-2}},
                              .coupled = true};
  CHECK(with_step(clock, "structure", 2));
  CHECK_FALSE(with_step(clock, "structure", 4));
  CHECK(with_window(clock, 0.5));
  CHECK_FALSE(with_window(clock, 0.25));  // steps of 4 ms in windows of 2 ms
  CHECK_FALSE(with_window(clock, 2));     // the particles' step goes along
  CHECK(with_all(clock, 0.125));
}

}  // namespace talus
