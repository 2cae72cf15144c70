#include "coupler/study/study.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/program/log.hpp"
#include "coupler/study/load.hpp"
#include "coupler/study/plan.hpp"
#include "coupler/study/runner.hpp"
#include "tests/support/folder.hpp"

namespace talus {
namespace {

using nlohmann::json;
using test::Folder;

/// The fake program's peak is 3 + step^order: the truth is 3, and errors are known.
const char* const study_text = R"(
title: A study
study:
  base: base.yaml
  sweep: {keys: [model.step], values: [100 ms, 200 ms, 400 ms], unit: s, label: step}
  methods:
    first: {set: [{key: model.order, value: 1}]}
    second: {set: [{key: model.order, value: 2}, {key: model.unstable_from, value: 300 ms}]}
  quantities:
    peak: {peak: {column: net.z}}
    course: {history: {column: net.z, until: 1 s}}
    energy: {summary: {pointer: /energy/largest_error_relative, ideal: 0}}
  reference: {method: second, values: [40 ms, 20 ms, 10 ms], order: 2}
  second: {method: first, values: [8 ms, 4 ms, 2 ms], order: 1}
  repeats: 2
  largest_energy_error: 1
)";

struct Study {
  explicit Study(const std::string& text = study_text) : folder("study") {
    core::show_log_from(core::LogLevel::error);
    folder.add("base.yaml", "model: {step: 1 s}\n").add("study.yaml", text);
  }
  study::StudyRequest request() const {
    return {.study = folder / "study.yaml", .out = folder / "out", .program = TALUS_FAKE_PROGRAM};
  }
  json result() const { return json::parse(test::text_of(folder / "out/study.json")); }
  /// How often the fake program was asked to compute the point.
  std::ptrdiff_t runs_of(const std::string& id) const {
    const auto order = this->order();
    return std::count(order.begin(), order.end(), id);
  }
  std::vector<std::string> order() const {
    std::ifstream file(folder / "order.txt");
    std::vector<std::string> all;
    for (std::string line; std::getline(file, line);) all.push_back(line);
    return all;
  }
  mutable Folder folder;
};

const json& quantity(const json& result, const std::string& name) {
  for (const auto& q : result.at("quantities"))
    if (q.at("name") == name) return q;
  throw std::runtime_error("no quantity " + name);
}
const json& point(const json& points, const std::string& id) {
  for (const auto& p : points)
    if (p.at("id") == id) return p;
  throw std::runtime_error("no point " + id);
}

std::string error_of(const std::string& text) {
  const Study study(text);
  try {
    study::load_study(study.folder / "study.yaml");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}
std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

}  // namespace

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
