#pragma once

#include <cstddef>

#include "core/scene/fields.hpp"
#include "core/scene/tree.hpp"

namespace talus::core {

/// Where a value stands, for the complaints about it.
struct Location {
  std::string key_path;
  Place place;
};

/// Reads one section of a scene, given as the node of its map.
class SectionReader final : public Fields {
 public:
  /// @pre node is a map and outlives the reader
  SectionReader(const SceneNode& node, Location location, std::vector<Complaint>& complaints);
  /// Complains about the keys nobody asked for.
  void finish();

  /// Reads the value of `entry` as a section: complains where it is no map, else describes it.
  static void read(const SceneNode& value, const Location& location, const Describe& describe,
                   std::vector<Complaint>& complaints);

  void rule(bool holds, const char* key, const std::string& message) override;
  std::string place() const override;
  void scalar(const char* key, ScalarSlot slot, Presence presence, KeyTraits traits, Assign assign) override;
  void choose(const char* key, int default_index, const Choices& names, const char* help, Presence presence,
              std::function<void(int)> assign) override;
  void nested(const char* key, Presence presence, const char* help, Describe describe) override;
  void nested_list(const char* key, std::size_t least, const char* help, Describe describe_one) override;
  void nested_map(const char* key, std::size_t least, const char* help,
                  std::function<void(const std::string&, Fields&)> describe_one) override;
  void nested_choice(const std::vector<Alternative>& alternatives, Presence presence,
                     std::function<void(std::size_t, Fields&)> describe_one) override;

 private:
  /// The entry of a key, which is thereby known; null where it is absent, with a complaint where it is
  /// required.
  const SceneEntry* entry(const char* key, Presence presence, const std::string& expected);
  bool has_errors() const;
  Location location_of(const SceneEntry& entry) const;
  std::string path_of(const std::string& key) const;
  void complain(const Location& location, const std::string& message);

  const SceneNode& node_;
  Location location_;
  std::vector<Complaint>& complaints_;
  std::ptrdiff_t complaints_before_;
  std::vector<std::string> known_;
};

}  // namespace talus::core
