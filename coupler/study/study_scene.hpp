#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"

/// A study as it is written: `title:` and `study:` in a file of its own (docs/studies.md).
namespace talus::study {

/// `{key: coupling.window, value: 1 ms}`: a value laid over the base scene, as YAML.
struct Setting {
  std::string key;
  std::string value;
};
void describe(core::Fields& fields, Setting& setting);

/// One curve of the plots: a scene with these settings, at each value of the sweep.
struct Method {
  std::optional<std::filesystem::path> base;  ///< absent: that of the study
  std::vector<Setting> set;
  std::vector<std::string> keys;  ///< that the sweep's values go to; none: those of the sweep
};
void describe(core::Fields& fields, Method& method);

/// What is varied along each curve. All `keys` get the same value.
struct Sweep {
  std::vector<std::string> keys;
  std::vector<std::string> values;
  std::string unit;
  std::string label;
};
void describe(core::Fields& fields, Sweep& sweep);

/// The value of largest magnitude of a probe column.
struct PeakQuantity {
  std::string column;
};
void describe(core::Fields& fields, PeakQuantity& quantity);
/// A probe column over time; its error is the root mean square of the difference over that of the reference.
struct HistoryQuantity {
  std::string column;
  std::optional<double> until;  ///< s
};
void describe(core::Fields& fields, HistoryQuantity& quantity);
/// A number of summary.json, e.g. `/energy/error_relative`.
struct SummaryQuantity {
  std::string pointer;
  std::optional<double> ideal;  ///< known exact value; the error is then the plain difference from it
};
void describe(core::Fields& fields, SummaryQuantity& quantity);

struct Quantity {
  std::variant<PeakQuantity, HistoryQuantity, SummaryQuantity> source;
};
void describe(core::Fields& fields, Quantity& quantity);

/// Runs whose extrapolation is taken as the truth where they show nearly the order that is expected of them.
struct Reference {
  std::string method;
  std::vector<std::string> values;  ///< three or more, the finest last
  double order = 2;                 ///< expected
};
void describe(core::Fields& fields, Reference& reference);

/// Errors over one sweep, or (with `across`) a map of what works over two.
struct StudyScene {
  std::filesystem::path base;
  Sweep sweep;
  std::optional<Sweep> across;
  std::vector<std::pair<std::string, Method>> methods;
  std::vector<std::pair<std::string, Quantity>> quantities;
  std::optional<Reference> reference, second;
  std::int64_t repeats = 5;
  std::int64_t threads = 1;
  std::int64_t cores = 0;
  double time_limit = 600;             ///< s
  double largest_energy_error = 0.05;  ///< share of the impact's energy; a point beyond counts as inaccurate
};
void describe(core::Fields& fields, StudyScene& study);

struct LoadedStudy {
  std::string title;
  StudyScene scene;
};
/// @throws ConfigError with every complaint
LoadedStudy load_study(const std::filesystem::path& path);

/// The keys of a study as Markdown.
std::string study_schema();

}  // namespace talus::study
