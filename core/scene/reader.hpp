#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/scene/fields.hpp"

namespace talus::core {

/// The top-level keys of a scene.
const std::vector<std::string>& scene_sections();

/// A scene file, read and overlaid on what it `extends`, not yet interpreted. Strict about YAML itself:
/// duplicate keys, aliases that loop, a file that is no YAML, is empty, nests deeper than 64 or is larger
/// than 16 MB are errors that name the place.
///
/// `extends: base.yaml` (relative to the file it stands in) lays the file over another: maps are merged key
/// by key, lists and scalars replaced, and `key: ~` removes the base's key. Where the later file names
/// another alternative of a choice (Fields::one_of), it replaces the base's.
///
/// `structure: {solver: NAME}` is read as `structure: {solver: {program: NAME}}`, and so for the particles.
class SceneFile {
 public:
  /// @throws ConfigError where the text cannot be read at all. Duplicate keys are kept for
  /// SceneReader::finish(), to be told with the rest.
  static SceneFile load(const std::filesystem::path& path);
  static SceneFile parse(const std::string& text, const std::filesystem::path& name);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;

  const std::filesystem::path& path() const;
  /// The scene's `title`, or the stem of its file name where it has none.
  std::string title() const;
  /// A path written in the scene, relative to the file it stands in.
  std::filesystem::path resolve(const std::string& written) const;
  /// The path that stands at "structure.solver", relative to the file it was written in, which may be one
  /// that this scene extends. Empty where nothing or no text stands there.
  std::filesystem::path path_at(const std::string& key_path) const;
  /// The files that the scene names anywhere, such as meshes and solvers: every text of it that, taken from the
  /// folder of the file it is written in, is the path of a file. Sorted, each once.
  std::vector<std::filesystem::path> named_files() const;
  /// Hexadecimal digest of the effective content (after `extends`), the `scene_hash` of summaries.
  std::string hash() const;
  bool has_section(const std::string& key) const;
  /// Replaces or adds one value, as a study does: set("structure.step", "50 us"),
  /// set("particles.contacts[0].friction", "{coefficient: 0.4}"). The value is YAML; "~" removes the key.
  /// @throws ConfigError where the path or the value cannot be read.
  void set(const std::string& key_path, const std::string& value);
  /// The effective scene as YAML text, in one canonical spelling. A choice that an overlay replaced still
  /// shows the base's alternative.
  std::string text() const;

  /// Reads one top-level section with its description; complaints are collected, not thrown, so that a
  /// program reports all of a file at once. Use `SceneReader` below for the usual case.
  void read(const std::string& section, Presence presence, const std::function<void(Fields&)>& describe,
            std::vector<Complaint>& complaints) const;
  /// Complains about duplicate keys, top-level keys that are not in `known`, and a title that is no text.
  void check_sections(const std::vector<std::string>& known, std::vector<Complaint>& complaints) const;

 private:
  SceneFile();
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Logs the warnings among complaints and takes them out, so that what is left are errors.
void log_warnings(std::vector<Complaint>& complaints);

/// Reads the sections of a scene one after the other and throws once at the end, with every complaint.
///
///     SceneReader reader(file);
///     auto time = reader.required<TimeScene>("time");
///     auto structure = reader.optional<StructureScene>("structure");
///     reader.finish();
class SceneReader {
 public:
  /// `known`: the top-level keys that may stand in the file, whether this program reads them or not.
  explicit SceneReader(const SceneFile& file, std::vector<std::string> known = scene_sections())
      : file_(file), known_(std::move(known)) {}

  template <class Section>
  Section required(const std::string& key) {
    Section section;
    file_.read(
        key, Presence::required, [&](Fields& fields) { describe(fields, section); }, complaints_);
    return section;
  }
  template <class Section>
  std::optional<Section> optional(const std::string& key) {
    std::optional<Section> section;
    file_.read(
        key, Presence::optional, [&](Fields& fields) { describe(fields, section.emplace()); }, complaints_);
    return section;
  }
  /// A complaint found by the caller, e.g. a name that no other section defines.
  void complain(Complaint complaint) { complaints_.push_back(std::move(complaint)); }
  /// Warnings are none.
  bool has_complaints() const;
  /// Logs the warnings. @throws ConfigError with all complaints so far, sorted by place.
  void finish();

 private:
  const SceneFile& file_;
  std::vector<std::string> known_;
  std::vector<Complaint> complaints_;
};

/// The section's keys as Markdown: a table a section with key, type, unit, allowed values, default and help.
/// Printed by `talus schema` and by each solver's `--schema` into docs/schema.md.
std::string schema_markdown(const std::string& section, const std::string& help,
                            const std::function<void(Fields&)>& describe);

}  // namespace talus::core
