#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/scene/fields.hpp"

namespace talus::core {

/// A scene file, read and overlaid on what it `extends`, not yet interpreted. Strict about YAML itself: duplicate keys, aliases that
/// loop, a file that is no YAML, is empty, nests deeper than 64 or is larger than 16 MB are errors that name the place.
class SceneFile {
 public:
  /// @throws ConfigError with every complaint about the text.
  static SceneFile load(const std::filesystem::path& path);
  static SceneFile parse(const std::string& text, const std::filesystem::path& name);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;

  const std::filesystem::path& path() const;
  /// A path written in the scene, relative to the file it stands in.
  std::filesystem::path resolve(const std::string& written) const;
  /// Hexadecimal digest of the effective content (after `extends`), the `scene_hash` of summaries.
  std::string hash() const;
  bool has_section(const std::string& key) const;
  /// Replaces or adds one value, as a study does: set("structure.step", "50 us").
  void set(const std::string& key_path, const std::string& value);
  /// The effective scene as YAML text.
  std::string text() const;

  /// Reads one top-level section with its description; complaints are collected, not thrown, so that a program reports all of
  /// a file at once. Use `SceneReader` below for the usual case.
  void read(const std::string& section, Presence presence, const std::function<void(Fields&)>& describe,
            std::vector<Complaint>& complaints) const;
  /// Complains about top-level keys that are not in `known`.
  void check_sections(const std::vector<std::string>& known, std::vector<Complaint>& complaints) const;

 private:
  SceneFile();
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Reads the sections of a scene one after the other and throws once at the end, with every complaint.
///
///     SceneReader reader(file);
///     auto time = reader.required<TimeScene>("time");
///     auto structure = reader.optional<StructureScene>("structure");
///     reader.finish();
class SceneReader {
 public:
  explicit SceneReader(const SceneFile& file) : file_(file) {}

  template <class Section>
  Section required(const std::string& key) {
    Section section;
    file_.read(key, Presence::required, [&](Fields& fields) { describe(fields, section); }, complaints_);
    return section;
  }
  template <class Section>
  std::optional<Section> optional(const std::string& key) {
    std::optional<Section> section;
    file_.read(key, Presence::optional, [&](Fields& fields) { describe(fields, section.emplace()); }, complaints_);
    return section;
  }
  /// A complaint found by the caller, e.g. a name that no other section defines.
  void complain(Complaint complaint) { complaints_.push_back(std::move(complaint)); }
  /// @throws ConfigError with all complaints so far, sorted by place.
  void finish();

 private:
  const SceneFile& file_;
  std::vector<Complaint> complaints_;
};

/// The section's keys as Markdown: a table a section with key, type, unit, allowed values, default and help. Printed by
/// `talus schema` and by each solver's `--schema` into docs/schema.md.
std::string schema_markdown(const std::string& section, const std::string& help, const std::function<void(Fields&)>& describe);

}  // namespace talus::core
