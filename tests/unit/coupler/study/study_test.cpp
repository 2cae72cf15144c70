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

TEST_CASE("a study finds the errors of a model that is known, against its extrapolated reference") {
  const Study study;
  REQUIRE(study::run_study(study.request()) == core::ExitCode::success);
  const json result = study.result();
  const json& peak = quantity(result, "peak");
  CHECK(peak.at("reference").get<double>() == Approx(3).epsilon(1e-13));
  CHECK(peak.at("observed_order").get<double>() == Approx(2).epsilon(1e-6));
  CHECK(peak.at("second_differs").get<double>() < 1e-13);
  // The truth is 3 and the finest run is 1e-4 off, which is how far the reference is trusted.
  CHECK(peak.at("reference_high").get<double>() == Approx(3 + 1e-4).epsilon(1e-12));
  CHECK(peak.at("trusted") == true);
  CHECK(point(peak.at("points"), "first_100_ms").at("error").get<double>() == Approx(0.1 / 3));
  CHECK(point(peak.at("points"), "second_200_ms").at("error").get<double>() == Approx(0.04 / 3));
  CHECK(point(quantity(result, "energy").at("points"), "first_200_ms").at("error").get<double>() ==
        Approx(0.2));
  // The history is 0 and the peak at 0 s and 1 s; until 1 s its relative error is that of the peak.
  CHECK(point(quantity(result, "course").at("points"), "first_100_ms").at("error").get<double>() ==
        Approx(0.1 / 3));
}

TEST_CASE("a point that broke down is shown with its outcome and message, not dropped") {
  const Study study;
  study::run_study(study.request());
  const json result = study.result();
  const json& broken = point(result.at("points"), "second_400_ms");
  CHECK(broken.at("outcome") == "failed");
  CHECK(broken.at("detail") == "unstable");
  CHECK(broken.at("message") == "it blew up");
  CHECK_THAT(test::text_of(study.folder / "out/study.csv"),
             Catch::Contains("second,400 ms,0.4,,failed,unstable,,,,"));
  CHECK_THAT(test::text_of(study.folder / "out/index.html"), Catch::Contains("it blew up"));
}

TEST_CASE("a run that does not end is given up and shown as too slow") {
  Study study(replaced(replaced(study_text, "repeats: 2", "repeats: 1\n  time_limit: 0.5 s"),
                       "value: 300 ms}", "value: 300 ms}, {key: model.hangs, value: true}"));
  study::run_study(study.request());
  CHECK(point(study.result().at("points"), "second_100_ms").at("detail") == "too slow");
  CHECK_THAT(quantity(study.result(), "peak").at("note").get<std::string>(),
             Catch::Contains("did not succeed"));
}

TEST_CASE("points that are complete are not run again, and those of a changed scene are") {
  const Study study;
  study::run_study(study.request());
  CHECK(study.runs_of("first_100_ms") == 2);
  study::run_study(study.request());
  CHECK(study.runs_of("first_100_ms") == 2);
  std::ofstream(study.folder / "study.yaml")
      << replaced(study_text, "{key: model.order, value: 1}", "{key: model.order, value: 3}");
  study::run_study(study.request());
  CHECK(study.runs_of("first_100_ms") == 4);
  CHECK(study.runs_of("second_100_ms") == 2);
}

TEST_CASE(
    "a method may have a scene of its own, and a run that is only there for the reference is timed once") {
  const Study study(
      replaced(study_text, "first: {set: [{key: model.order, value: 1}]}", "first: {base: other.yaml}"));
  study.folder.add("other.yaml", "model: {step: 1 s, order: 3}\n");
  study::run_study(study.request());
  const json result = study.result();
  CHECK(point(quantity(result, "peak").at("points"), "first_200_ms").at("error").get<double>() ==
        Approx(0.008 / 3));
  CHECK(study.runs_of("first_200_ms") == 2);
  CHECK(study.runs_of("first_4_ms") == 1);
  CHECK_THAT(error_of(replaced(study_text, "first: {set: [", "first: {base: nothing.yaml, set: [")),
             Catch::Contains("study.methods.first.base: no such file"));
}

TEST_CASE("shares of a study cover each point once, and missing points are shown as missing") {
  const Study study;
  auto request = study.request();
  request.parts = 3;
  for (request.part = 0; request.part < 3; ++request.part) {
    CHECK(study::run_study(request) == core::ExitCode::success);
    const json result = study.result();
    const auto missing = std::count_if(result.at("points").begin(), result.at("points").end(),
                                       [](const json& p) { return p.at("outcome") == "missing"; });
    CHECK((missing == 0) == (request.part == 2));
  }
  request.part = 3;
  CHECK_THROWS_AS(study::run_study(request), core::ConfigError);
}

TEST_CASE("a map has a point for each pair of values, with its outcome") {
  const Study study(R"(
study:
  base: base.yaml
  sweep: {keys: [model.step], values: [100 ms, 200 ms, 400 ms], unit: s}
  across: {keys: [model.unstable_from], values: [150 ms, 300 ms], unit: s, label: limit}
  methods: {only: {}}
  repeats: 1
  largest_energy_error: 1
)");
  REQUIRE(study::run_study(study.request()) == core::ExitCode::success);
  const json result = study.result();
  CHECK(result.at("across") == "limit");
  REQUIRE(result.at("points").size() == 6);
  for (const auto& p : result.at("points")) {
    const double limit = p.at("across") == "150 ms" ? 0.15 : 0.3;
    CHECK((p.at("outcome") == "ok") == (p.at("position").get<double>() < limit));
  }
}

TEST_CASE("timings are median, least and most of the repeats, and the portable work is kept") {
  const Study study;
  study::run_study(study.request());
  const json result = study.result();
  const json& one = point(result.at("points"), "first_200_ms");
  CHECK(one.at("loop_seconds").at("median").get<double>() == Approx(5e-3));
  CHECK(one.at("loop_seconds").at("runs") == 2);
  CHECK(one.at("work").at("solver_calls") == 7);
}

TEST_CASE("the winner is the fastest to an error and the most exact in a time") {
  const Study study;
  study::run_study(study.request());
  const json result = study.result();
  const json& peak = quantity(result, "peak");
  // Errors below 1 %: only second at 100 ms (0.33 %); its time is 1e-3 / 0.1 s.
  const json& one_percent = peak.at("fastest_to").at(1);
  CHECK(one_percent.at("error") == 0.01);
  CHECK(one_percent.at("winner") == "second");
  CHECK(one_percent.at("methods").at("second").at("value").get<double>() == Approx(1e-2));
  CHECK_FALSE(one_percent.at("methods").contains("first"));
  CHECK(peak.at("most_exact_within").at(0).at("winner") == "second");
}

TEST_CASE("the values of the sweep go to a method's own keys where it has some") {
  const Study study(replaced(study_text, "first: {", "first: {keys: [model.mesh.size], "));
  for (const auto& run : study::plan(study::load_study(study.folder / "study.yaml").scene, "runs")) {
    INFO(run.scene);
    const bool own = run.method == "first";
    CHECK((run.scene.find("size") != std::string::npos) == own);
    CHECK((run.scene.find("step") != std::string::npos) == !own);
  }
}

TEST_CASE("every study of the repository can be planned") {
  std::size_t planned = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TALUS_SOURCE_DIR "/configs/studies")) {
    INFO(entry.path());
    planned += study::plan(study::load_study(entry.path()).scene, "results/study/runs").size();
  }
  CHECK(planned > 0);
}

TEST_CASE("what a study asks wrongly is told before anything runs") {
  CHECK_THAT(error_of(replaced(study_text, "method: second, values", "method: third, values")),
             Catch::Contains("study.reference.method: there is no method 'third'"));
  CHECK_THAT(error_of(replaced(study_text, "400 ms]", "400 kg]")),
             Catch::Contains("'400 kg' is no value in s"));
  CHECK_THAT(error_of(replaced(study_text, "  repeats: 2", "  across: {keys: [a], values: [1]}")),
             Catch::Contains("either `quantities`"));
  CHECK_THAT(error_of(replaced(study_text, "base.yaml", "nothing.yaml")),
             Catch::Contains("study.base: no such file"));
  CHECK_THAT(error_of(replaced(study_text, "[40 ms, 20 ms, 10 ms]", "[40 ms, 20 ms]")),
             Catch::Contains("needs three values at least") && Catch::Contains("it has 2"));
  CHECK_THAT(error_of(replaced(study_text, "key: model.order", "key: 'model[0].order'")),
             Catch::Contains("set the whole list"));
  CHECK_THAT(error_of(replaced(study_text, "pointer: /energy", "pointer: energy")),
             Catch::Contains("must start with '/'"));
}

}  // namespace talus
