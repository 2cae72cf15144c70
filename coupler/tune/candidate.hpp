#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/accuracy/clock.hpp"
#include "coupler/study/study_scene.hpp"

namespace talus::tune {

/// One choice of settings in place of the scene's.
struct Change {
  std::string group;  ///< of choices that exclude each other: "contact", "scheme", "friction of particles"
  std::string name;   ///< for people: "implicit contact"
  std::vector<study::Setting> settings;
  std::string reason;  ///< for the comment in the overlay
  bool drops_an_effect = false;
};

/// Settings that may be tried: steps and windows, and any number of choices. That of no sides and no choices
/// is the scene as given.
struct Candidate {
  accuracy::Clock clock;
  std::vector<Change> changes;

  /// With a choice in place of that of its group.
  Candidate with(const Change& change) const;
  const Change* change_in(const std::string& group) const;
  std::vector<study::Setting> settings() const;
  /// "steps 25 us and 50 us in windows of 100 us, implicit contact"
  std::string name() const;
  /// The name of its folder: the same settings have the same one.
  std::string id() const;
};

}  // namespace talus::tune
