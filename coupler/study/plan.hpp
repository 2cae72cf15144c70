#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::study {

/// One point of a study: the base scene with a method's settings and a value of the sweep. Independent of all
/// others.
struct PlannedRun {
  std::string id;  ///< name of its folder: method and value, safe for file systems
  std::string method;
  std::string value;    ///< as written
  double position = 0;  ///< the value in the sweep's SI unit
  std::string across;   ///< the value of the second sweep; empty where there is none
  bool shown = true;    ///< false: only for the reference
  std::string scene;    ///< the text of its scene, which extends the base
};

/// Every point once, those of the references included, in the order of the methods.
/// @param folder of the runs' folders, from where the scenes name their base
std::vector<PlannedRun> plan(const StudyScene& study, const std::filesystem::path& folder);

}  // namespace talus::study
