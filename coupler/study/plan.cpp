#include "coupler/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/units/units.hpp"
#include "coupler/study/scene_text.hpp"

namespace talus::study {
namespace {

std::string file_name(const std::string& text) {
  std::string name = text;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '-' && c != '_'; }, '_');
  return name;
}

class Planner {
 public:
  Planner(const StudyScene& study, const std::filesystem::path& folder)
      : study_(study), run_folder_(std::filesystem::absolute(folder) / "run") {}

  void add(const std::string& method, const std::vector<std::string>& values, bool shown) {
    const auto found = std::find_if(study_.methods.begin(), study_.methods.end(),
                                    [&](const auto& m) { return m.first == method; });
    const std::vector<std::string> nothing{""};
    for (const auto& across : study_.across ? study_.across->values : nothing)
      for (const auto& value : values) add(*found, value, across, shown);
  }
  std::vector<PlannedRun> take() { return std::move(runs_); }

 private:
  void add(const std::pair<std::string, Method>& method, const std::string& value, const std::string& across,
           bool shown) {
    const std::string id = file_name(method.first + "_" + value + (across.empty() ? "" : "_" + across));
    const auto same = std::find_if(runs_.begin(), runs_.end(), [&](const auto& run) { return run.id == id; });
    if (same != runs_.end()) {
      same->shown |= shown;
      return;
    }
    std::vector<Setting> settings = method.second.set;
    const auto& keys = method.second.keys.empty() ? study_.sweep.keys : method.second.keys;
    for (const auto& key : keys) settings.push_back({key, value});
    if (study_.across)
      for (const auto& key : study_.across->keys) settings.push_back({key, across});
    runs_.push_back({.id = id,
                     .method = method.first,
                     .value = value,
                     .position = core::parse_quantity(value, study_.sweep.unit).value_or(0),
                     .across = across,
                     .shown = shown,
                     .scene = scene_text(settings, base_of(method.second))});
  }

  /// As a scene in the folder of a run names it.
  std::filesystem::path base_of(const Method& method) const {
    return std::filesystem::proximate(std::filesystem::absolute(method.base.value_or(study_.base)),
                                      run_folder_);
  }

  const StudyScene& study_;
  std::filesystem::path run_folder_;
  std::vector<PlannedRun> runs_;
};

}  // namespace

std::vector<PlannedRun> plan(const StudyScene& study, const std::filesystem::path& folder) {
  Planner planner(study, folder);
  for (const auto& method : study.methods) planner.add(method.first, study.sweep.values, true);
  for (const auto& reference : {study.reference, study.second})
    if (reference) planner.add(reference->method, reference->values, false);
  return planner.take();
}

}  // namespace talus::study
