#include "core/scene/section_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "core/scene/values.hpp"

namespace talus::core {
namespace {

bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace

SectionReader::SectionReader(const SceneNode& node, Location location, std::vector<Complaint>& complaints)
    : node_(node),
      location_(std::move(location)),
      complaints_(complaints),
      complaints_before_(static_cast<std::ptrdiff_t>(complaints.size())) {}

void SectionReader::read(const SceneNode& value, const Location& location, const Describe& describe,
                         std::vector<Complaint>& complaints) {
  if (value.kind != SceneNode::Kind::map) {
    const char* hint = value.kind == SceneNode::Kind::null ? "; write {} for one without keys" : "";
    complaints.push_back(complaint(value.place.line ? value.place : location.place, location.key_path,
                                   fmt::format("expects a section of keys, got {}{}", shown(value), hint)));
    return;
  }
  SectionReader inner(value, location, complaints);
  describe(inner);
  inner.finish();
}

void SectionReader::finish() {
  for (const auto& entry : node_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    const std::string hint = did_you_mean(entry.key, known_);
    const bool digits = std::ranges::all_of(entry.key, [](unsigned char c) { return std::isdigit(c); });
    if (digits && entry.value.kind == SceneNode::Kind::null) {
      complain(location_of(entry),
               "is no key: a comma parts entries here; decimals are written with a point");
      continue;
    }
    complain(location_of(entry),
             fmt::format("unknown key{}{} known here: {}", hint, hint.empty() ? ";" : "",
                         known_.empty() ? "none" : fmt::format("{}", fmt::join(known_, ", "))));
  }
}

void SectionReader::rule(bool holds, const char* key, const std::string& message) {
  if (holds || has_errors()) return;
  const SceneEntry* found = node_.find(key);
  complain(found ? Location{path_of(key), found->value.place} : location_, message);
}

bool SectionReader::has_errors() const {
  return std::any_of(complaints_.begin() + complaints_before_, complaints_.end(),
                     [](const Complaint& complaint) { return !complaint.warning; });
}

std::string SectionReader::place() const {
  return text(location_.place);
}

const SceneEntry* SectionReader::entry(const char* key, Presence presence, const std::string& expected) {
  known_.emplace_back(key);
  const SceneEntry* found = node_.find(key);
  if (!found && presence == Presence::required)
    complain({path_of(key), location_.place}, fmt::format("is missing; expects {}", expected));
  return found;
}

std::string SectionReader::path_of(const std::string& key) const {
  return location_.key_path.empty() ? key : location_.key_path + "." + key;
}

Location SectionReader::location_of(const SceneEntry& entry) const {
  return {path_of(entry.key), entry.place};
}

void SectionReader::complain(const Location& location, const std::string& message) {
  complaints_.push_back(complaint(location.place, location.key_path, message));
}

void SectionReader::scalar(const char* key, ScalarSlot slot, Presence presence, KeyTraits traits,
                           Assign assign) {
  const SceneEntry* found = entry(key, presence, expected_value(slot, traits));
  if (found && read_value(found->value, location_of(*found), slot, traits, complaints_)) assign();
}

void SectionReader::choose(const char* key, int, const Choices& names, const char*, Presence presence,
                           std::function<void(int)> assign) {
  const std::vector<std::string> known(names.begin(), names.end());
  const std::string expected = fmt::format("one of {}", fmt::join(known, ", "));
  const SceneEntry* found = entry(key, presence, expected);
  if (!found) return;
  const auto match = std::find(known.begin(), known.end(), found->value.scalar);
  if (match != known.end()) return assign(static_cast<int>(match - known.begin()));
  complain({path_of(key), found->value.place},
           fmt::format("expects {}, got {}{}", expected, shown(found->value),
                       did_you_mean(found->value.scalar, known)));
}

void SectionReader::nested(const char* key, Presence presence, const char*, Describe describe) {
  const SceneEntry* found = entry(key, presence, "a section of keys");
  if (found) read(found->value, location_of(*found), describe, complaints_);
}

void SectionReader::nested_list(const char* key, std::size_t least, const char*, Describe describe_one) {
  const SceneEntry* found = entry(key, least ? Presence::required : Presence::optional, "a list of sections");
  if (!found) return;
  const Location location = location_of(*found);
  if (found->value.kind != SceneNode::Kind::list)
    return complain(location, fmt::format("expects a list of sections, got {}", shown(found->value)));
  const auto& items = found->value.items;
  if (items.size() < least)
    complain(location, fmt::format("needs at least {} entries, has {}", least, items.size()));
  for (std::size_t i = 0; i < items.size(); ++i)
    read(items[i], {fmt::format("{}[{}]", location.key_path, i), items[i].place}, describe_one, complaints_);
}

void SectionReader::nested_map(const char* key, std::size_t least, const char*,
                               std::function<void(const std::string&, Fields&)> describe_one) {
  const SceneEntry* found = entry(key, least ? Presence::required : Presence::optional, "named sections");
  if (!found) return;
  const Location location = location_of(*found);
  if (found->value.kind != SceneNode::Kind::map)
    return complain(location, fmt::format("expects named sections, got {}", shown(found->value)));
  const auto& entries = found->value.entries;
  if (entries.size() < least)
    complain(location, fmt::format("needs at least {} entries, has {}", least, entries.size()));
  for (const auto& one : entries) {
    const Location inner{location.key_path + "." + one.key, one.place};
    if (!is_name(one.key)) complain(inner, "a name is made of letters, digits, _ and - only");
    read(
        one.value, inner, [&](Fields& fields) { describe_one(one.key, fields); }, complaints_);
  }
}

void SectionReader::nested_choice(const std::vector<Alternative>& alternatives, Presence presence,
                                  std::function<void(std::size_t, Fields&)> describe_one) {
  std::vector<std::pair<std::size_t, const SceneEntry*>> present;
  std::vector<std::string> keys;
  int latest = 0;  // rank: an overlay's choice replaces the base's
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    keys.emplace_back(alternatives[i].key);
    if (const SceneEntry* found = entry(alternatives[i].key, Presence::optional, {})) {
      present.emplace_back(i, found);
      latest = std::max(latest, found->rank);
    }
  }
  std::erase_if(present, [&](const auto& candidate) { return candidate.second->rank < latest; });
  if (present.empty() && presence == Presence::required)
    return complain(location_, fmt::format("needs one of the keys {}", fmt::join(keys, ", ")));
  for (std::size_t i = 1; i < present.size(); ++i)
    complain(location_of(*present[i].second),
             fmt::format("contradicts '{}' in line {}; only one of {} may be given", present[0].second->key,
                         present[0].second->place.line, fmt::join(keys, ", ")));
  if (present.size() != 1) return;
  const auto& [index, found] = present.front();
  read(
      found->value, location_of(*found), [&, i = index](Fields& fields) { describe_one(i, fields); },
      complaints_);
}

}  // namespace talus::core
