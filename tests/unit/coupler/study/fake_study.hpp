#pragma once

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "coupler/study/study.hpp"
#include "coupler/study/study_scene.hpp"
#include "tests/support/folder.hpp"

/// A study of a program whose errors are known, in a folder of its own.
namespace talus::test {

using nlohmann::json;

/// The fake program's peak is 3 + step^order: the truth is 3, and errors are known.
inline const char* const study_text = R"(
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

inline const json& quantity(const json& result, const std::string& name) {
  for (const auto& q : result.at("quantities"))
    if (q.at("name") == name) return q;
  throw std::runtime_error("no quantity " + name);
}
inline const json& point(const json& points, const std::string& id) {
  for (const auto& p : points)
    if (p.at("id") == id) return p;
  throw std::runtime_error("no point " + id);
}

inline std::string error_of(const std::string& text) {
  const Study study(text);
  try {
    study::load_study(study.folder / "study.yaml");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}
inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

}  // namespace talus::test
