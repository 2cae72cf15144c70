#include "coupler/tune/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/units/units.hpp"

namespace talus::tune {

Candidate Candidate::with(const Change& change) const {
  Candidate other = *this;
  std::erase_if(other.changes, [&](const Change& own) { return own.group == change.group; });
  if (!change.settings.empty()) other.changes.push_back(change);
  std::ranges::stable_sort(other.changes, {}, &Change::group);
  return other;
}

const Change* Candidate::change_in(const std::string& group) const {
  const auto found = std::ranges::find(changes, group, &Change::group);
  return found == changes.end() ? nullptr : &*found;
}

std::vector<study::Setting> Candidate::settings() const {
  auto all = accuracy::settings_of(clock);
  for (const auto& change : changes) all.insert(all.end(), change.settings.begin(), change.settings.end());
  return all;
}

std::string Candidate::name() const {
  if (clock.sides.empty()) return "the scene as given";
  std::string text;
  for (const auto& side : clock.sides)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side.name, core::readable(side.step, "s"));
  text += ", window " + core::readable(clock.window, "s");
  for (const auto& change : changes) text += ", " + change.name;
  return text;
}

std::string Candidate::id() const {
  std::uint64_t digest = 0xcbf29ce484222325u;  // FNV-1a
  for (const auto& setting : settings())
    for (const char c : setting.key + ":" + setting.value + "\n")
      digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", digest);
}

}  // namespace talus::tune
