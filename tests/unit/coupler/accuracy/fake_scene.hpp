#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/program/log.hpp"
#include "coupler/accuracy/error_bars.hpp"
#include "tests/support/folder.hpp"

/// A scene of the fake program (fake_run.cpp), whose truth is a peak of 3.
namespace talus::test {

inline const char* const three_clocks = R"(
title: A run whose errors are known
time: {end: 1 s}
coupling: {window: 8 ms}
structure: {step: 4 ms}
particles: {step: 2 ms}
interface: {}
)";

class FakeScene {
 public:
  explicit FakeScene(const std::string& text) : folder("accuracy") {
    core::show_log_from(core::LogLevel::error);
    folder.add("scene.yaml", text);
  }
  std::filesystem::path scene() const { return folder / "scene.yaml"; }
  /// Runs it as it is.
  void run() const {
    const std::string command = std::string(TALUS_FAKE_PROGRAM) + " run " + scene().string() + " --out " +
                                (folder / "result").string();
    if (std::system(command.c_str()) != 0) throw std::runtime_error("the fake program failed");
  }
  /// Its peak with its error bars.
  nlohmann::json bars() const {
    run();
    accuracy::add_error_bars(
        {.scene = scene(), .result = folder / "result", .program = TALUS_FAKE_PROGRAM, .jobs = 2});
    return nlohmann::json::parse(std::ifstream(folder / "result/summary.json")).at("error_bars");
  }
  mutable Folder folder;
};

}  // namespace talus::test
