// What becomes of points: made anew, repeated, interrupted, inaccurate, tied.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "coupler/study/load.hpp"
#include "coupler/study/plan.hpp"
#include "coupler/study/runner.hpp"
#include "tests/unit/coupler/study/fake_study.hpp"

namespace talus {

using namespace test;

TEST_CASE(
    "a point is computed anew where its base scene, a file that this names, or the program changed, and only "
    "then") {
  const Study study;
  study.folder.add("net.msh", "nodes").add("other.txt", "");
  study.folder.add("base.yaml", "mesh: net.msh\nmodel: {step: 1 s}\n");
  std::filesystem::create_directory(study.folder / "bin");
  auto request = study.request();
  request.program = study.folder / "bin/talus";
  std::filesystem::copy(TALUS_FAKE_PROGRAM, request.program);
  std::ptrdiff_t expected = 2;
  const auto runs_after = [&](bool again) {
    study::run_study(request);
    expected += again ? 2 : 0;
    return study.runs_of("first_100_ms") == expected;
  };
  CHECK(runs_after(false));
  study.folder.add("other.txt", "changed");  // which nothing names
  study.folder.add("base.yaml", "# a comment\nmesh: net.msh\nmodel: {step: 1 s}\n");
  CHECK(runs_after(false));
  study.folder.add("base.yaml", "mesh: net.msh\nmodel: {step: 1 s, energy_factor: 0.5}\n");
  CHECK(runs_after(true));
  study.folder.add("net.msh", "other nodes");
  CHECK(runs_after(true));
  std::ofstream(request.program, std::ios::app) << "built anew";
  CHECK(runs_after(true));
  study.folder.add("bin/fem_solver", "a solver beside it");
  CHECK(runs_after(true));
}

TEST_CASE(
    "a page without new runs shows a point of another build as such, and one of another scene not at all") {
  const Study study;
  study.folder.add("bin/fem_solver", "of the first build");
  auto request = study.request();
  request.program = study.folder / "bin/talus";
  std::filesystem::copy(TALUS_FAKE_PROGRAM, request.program);
  study::run_study(request);
  CHECK_FALSE(point(study.result().at("points"), "first_100_ms").contains("stale"));
  request.page_only = true;
  study.folder.add("bin/fem_solver", "of the second");
  study::run_study(request);
  CHECK(point(study.result().at("points"), "first_100_ms").at("stale") == "the programs were built anew");
  study.folder.add("base.yaml", "model: {step: 1 s, energy_factor: 0.5}\n");
  study::run_study(request);
  const json result = study.result();
  const json& stale = point(result.at("points"), "first_100_ms");
  CHECK(stale.at("outcome") == "missing");
  CHECK(stale.at("message") == "its scene changed since it was computed");
}

TEST_CASE(
    "what the machine ended is tried again by the next call, what the scene or the numerics ended is not") {
  const Study study;
  study.folder.add("trouble", "");
  study::run_study(study.request());
  CHECK(study.runs_of("first_100_ms") == 1);  // not again and again in the same call
  const json ended = study.result();
  CHECK(point(ended.at("points"), "first_100_ms").at("outcome") == "failed");
  CHECK_THAT(point(ended.at("points"), "first_100_ms").at("message").get<std::string>(),
             Catch::Contains("killed by signal 9"));
  std::filesystem::remove(study.folder / "trouble");
  study::run_study(study.request());
  CHECK(point(study.result().at("points"), "first_100_ms").at("outcome") == "ok");
  CHECK(study.runs_of("second_400_ms") == 2);  // killed, then unstable
  study::run_study(study.request());
  CHECK(study.runs_of("second_400_ms") == 2);
}

TEST_CASE(
    "a scene that is refused stays refused, a time limit that was too short does not once it is longer") {
  const std::string text = R"(
study:
  base: base.yaml
  sweep: {keys: [model.step], values: [100 ms], unit: s}
  across: {keys: [model.order], values: [1]}
  methods:
    wrong: {set: [{key: model.nonsense, value: 1}]}
    endless: {set: [{key: model.hangs, value: true}]}
  repeats: 1
  time_limit: 1 s
)";
  const Study study(text);
  study::run_study(study.request());
  study::run_study(study.request());
  const json result = study.result();
  CHECK(point(result.at("points"), "wrong_100_ms_1").at("detail") == "refused");
  CHECK(point(result.at("points"), "endless_100_ms_1").at("detail") == "too slow");
  CHECK(study.runs_of("wrong_100_ms_1") == 1);
  CHECK(study.runs_of("endless_100_ms_1") == 1);
  study.folder.add("study.yaml", replaced(text, "time_limit: 1 s", "time_limit: 1.1 s"));
  study::run_study(study.request());
  CHECK(study.runs_of("wrong_100_ms_1") == 1);
  CHECK(study.runs_of("endless_100_ms_1") == 2);
}

TEST_CASE("repetitions are interleaved: every point once, methods in turn, before any point again") {
  const Study study;
  study::run_study(study.request());
  const auto order = study.order();
  const std::vector<std::string> shown{"first_100_ms",  "second_100_ms", "first_200_ms",
                                       "second_200_ms", "first_400_ms",  "second_400_ms"};
  REQUIRE(order.size() > shown.size());
  CHECK(std::vector(order.begin(), order.begin() + 6) == shown);
  CHECK(std::vector(order.end() - 5, order.end()) ==
        std::vector(shown.begin(), shown.end() - 1));  // 400 ms broke down
}

TEST_CASE("an interrupted study goes on with the repetitions that are missing") {
  const Study study(replaced(study_text, "repeats: 2", "repeats: 1"));
  study::run_study(study.request());
  std::ofstream(study.folder / "study.yaml") << study_text;  // two
  study::run_study(study.request());
  CHECK(study.runs_of("first_100_ms") == 2);
  CHECK(point(study.result().at("points"), "first_100_ms").at("loop_seconds").at("runs") == 2);
}

TEST_CASE("a point whose windows did not converge is shown with their share and never as good") {
  const Study study(
      replaced(study_text, "{key: model.order, value: 1}", "{key: model.not_converged, value: 74}"));
  study::run_study(study.request());
  const json result = study.result();
  const json& first = point(result.at("points"), "first_100_ms");
  CHECK(first.at("outcome") == "warnings");
  CHECK(first.at("detail") == "37 % of windows not converged");  // 74 of 400/2
  CHECK(point(result.at("points"), "second_100_ms").at("outcome") == "ok");
}

TEST_CASE(
    "a point whose balance of energy is off by more than the study allows is inaccurate, and so is a "
    "reference") {
  const Study study(replaced(study_text, "largest_energy_error: 1", "largest_energy_error: 0.15"));
  study::run_study(study.request());
  const json result = study.result();  // the fake's error is its step in s
  CHECK(point(result.at("points"), "first_100_ms").at("outcome") == "ok");
  const json& first = point(result.at("points"), "first_200_ms");
  CHECK(first.at("outcome") == "inaccurate");
  CHECK(first.at("detail") == "energy off by 20 %");
  const Study doubtful(replaced(study_text, "largest_energy_error: 1", "largest_energy_error: 0.03"));
  study::run_study(doubtful.request());
  CHECK(quantity(doubtful.result(), "peak").at("trusted") == false);
  CHECK_THAT(quantity(doubtful.result(), "peak").at("why").get<std::string>(),
             Catch::Contains("at 40 ms is itself in doubt"));
}

TEST_CASE(
    "a reference whose order is not the expected one is told as not trusted, with a range that holds the "
    "truth") {
  const Study study(
      replaced(study_text, "[40 ms, 20 ms, 10 ms], order: 2", "[40 ms, 20 ms, 10 ms], order: 1"));
  study::run_study(study.request());
  const json result = study.result();
  const json& peak = quantity(result, "peak");
  CHECK(peak.at("trusted") == false);
  CHECK(peak.at("observed_order").get<double>() == Approx(2).epsilon(1e-6));
  CHECK(peak.at("why") == "its three values show order 2, not 1");
  CHECK(peak.at("reference_low").get<double>() < 3);
  CHECK(peak.at("reference_high").get<double>() > 3);
}

TEST_CASE("every error has a bar: as wide as the reference is known, and none where the exact value is") {
  const Study study;
  study::run_study(study.request());
  const json result = study.result();
  const json& peak = point(quantity(result, "peak").at("points"), "second_100_ms");
  CHECK(peak.at("error_high").get<double>() - peak.at("error").get<double>() ==
        Approx(1e-4 / 3).epsilon(1e-3));
  const json& energy = point(quantity(result, "energy").at("points"), "second_100_ms");
  CHECK(energy.at("error_high") == energy.at("error_low"));
}

TEST_CASE("the load of others does not count what the study itself computes") {
  study::OtherLoad load;
  const double before = load.now();
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  volatile double sink = 0;
  while (std::chrono::steady_clock::now() < until) sink = sink + 1;
  CHECK(load.now() < before + 0.7);  // a whole core more, if it did
}

}  // namespace talus
