#include "coupler/study/study_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/reader.hpp"
#include "core/units/units.hpp"

namespace talus::study {

void describe(core::Fields& fields, Setting& setting) {
  fields.required("key", setting.key, {.help = "path of a key of the scene, such as coupling.window"});
  fields.required("value", setting.value, {.help = "its value, as YAML; ~ removes the key"});
  fields.rule(setting.key.find('[') == std::string::npos, "key",
              "an entry of a list cannot be set alone; set the whole list");
}

void describe(core::Fields& fields, Method& method) {
  fields.optional("base", method.base, {.help = "the scene of this method; that of the study where absent"});
  fields.list("set", method.set, "what differs from the base scene");
  fields.with_default(
      "keys", method.keys,
      {.help = "paths of the keys that get the value of the sweep where this method has others"});
}

void describe(core::Fields& fields, Sweep& sweep) {
  fields.required("keys", sweep.keys, {.help = "paths of the keys that get the value"});
  fields.required("values", sweep.values, {.help = "the values, with their units"});
  fields.with_default("unit", sweep.unit, {.help = "SI unit of the values, for the axis of the plot"});
  fields.with_default("label", sweep.label, {.help = "what the axis is called; the first key where absent"});
  fields.rule(!sweep.keys.empty() && !sweep.values.empty(), "values",
              "a sweep needs a key and a value at least");
}

void describe(core::Fields& fields, PeakQuantity& quantity) {
  fields.required("column", quantity.column, {.help = "a column of probes.csv"});
}
void describe(core::Fields& fields, HistoryQuantity& quantity) {
  fields.required("column", quantity.column, {.help = "a column of probes.csv"});
  fields.optional("until", quantity.until,
                  {.unit = "s", .range = core::positive, .help = "end of the part that is judged"});
}
void describe(core::Fields& fields, SummaryQuantity& quantity) {
  fields.required("pointer", quantity.pointer,
                  {.help = "a number of summary.json, such as /energy/error_relative"});
  fields.optional(
      "ideal", quantity.ideal,
      {.help = "its exact value where known, such as 0; the error is then the plain difference from it"});
  fields.rule(quantity.pointer.starts_with('/'), "pointer",
              "must start with '/', as in /energy/error_relative");
}

void describe(core::Fields& fields, Quantity& quantity) {
  fields.one_of(quantity.source, {{"peak", "the value of largest magnitude of a probe column"},
                                  {"history", "a probe column over time"},
                                  {"summary", "a number of the summary"}});
}

void describe(core::Fields& fields, Reference& reference) {
  fields.required("method", reference.method, {.help = "the method that computes it"});
  fields.required("values", reference.values,
                  {.help = "three or more values of the sweep, such as h, h/2 and h/4, the finest last"});
  fields.with_default(
      "order", reference.order,
      {.range = core::positive,
       .help = "order of convergence that is expected; a reference that shows another is not trusted"});
  fields.rule(
      reference.values.size() >= 3, "values",
      fmt::format("needs three values at least, such as [4 us, 2 us, 1 us], because the order of convergence "
                  "is computed from them; it has {}",
                  reference.values.size()));
}

void describe(core::Fields& fields, StudyScene& study) {
  fields.required("base", study.base, {.help = "the scene that everything starts from"});
  fields.section("sweep", study.sweep, "what is varied along each curve");
  fields.section("across", study.across,
                 "a second sweep: the study is then a map of stability, work and energy error over both");
  fields.map("methods", study.methods, "the curves or maps, by name", 1);
  fields.map("quantities", study.quantities, "what is judged, by name");
  fields.section("reference", study.reference, "what errors are measured against");
  fields.section(
      "second", study.second,
      "a second, independent way to the reference, which is no better known than by what the two differ");
  fields.rule(study.across.has_value() != !study.quantities.empty(), "quantities",
              "a study needs either `quantities`, to judge errors along the sweep, or `across`, to map what "
              "works over two sweeps");
  fields.rule(study.quantities.empty() == !study.reference, "reference",
              "`quantities` need a `reference`, and a map has none");
  fields.with_default("repeats", study.repeats,
                      {.range = {.low = 1, .high = 1000}, .help = "timed runs of each point"});
  fields.with_default("threads", study.threads,
                      {.range = {.low = 1, .high = 1024}, .help = "threads of each solver"});
  fields.with_default(
      "cores", study.cores,
      {.range = core::not_negative, .help = "cores that all runs are pinned to; 0: all there are"});
  fields.with_default(
      "time_limit", study.time_limit,
      {.unit = "s", .range = core::positive, .help = "wall time after which a run is given up"});
  fields.with_default(
      "largest_energy_error", study.largest_energy_error,
      {.range = core::positive,
       .help = "share of the impact's energy by which the balance of a point may be off; beyond it the "
               "point counts as inaccurate"});
}

namespace {

void check_method(const StudyScene& study, const Reference& reference, const std::string& key,
                  core::SceneReader& reader) {
  const bool known = std::any_of(study.methods.begin(), study.methods.end(),
                                 [&](const auto& m) { return m.first == reference.method; });
  if (!known)
    reader.complain({.key_path = "study." + key + ".method",
                     .message = fmt::format("there is no method '{}'", reference.method)});
}

void check_values(const std::vector<std::string>& values, const std::string& unit,
                  core::SceneReader& reader) {
  for (const auto& value : values)
    if (!core::parse_quantity(value, unit))
      reader.complain(
          {.key_path = "study",
           .message = fmt::format("'{}' is no value in {}", value, unit.empty() ? "plain numbers" : unit)});
}

void check_study(const StudyScene& study, core::SceneReader& reader) {
  check_values(study.sweep.values, study.sweep.unit, reader);
  if (study.across) check_values(study.across->values, study.across->unit, reader);
  for (const auto& [key, reference] :
       {std::pair("reference", study.reference), std::pair("second", study.second)}) {
    if (!reference) continue;
    check_method(study, *reference, key, reader);
    check_values(reference->values, study.sweep.unit, reader);
  }
}

}  // namespace

LoadedStudy load_study(const std::filesystem::path& path) {
  const auto file = core::SceneFile::load(path);
  core::SceneReader reader(file, {"title", "study"});
  LoadedStudy study{file.title(), reader.required<StudyScene>("study")};
  if (!reader.has_complaints()) check_study(study.scene, reader);
  reader.finish();
  return study;
}

std::string study_schema() {
  return core::schema_markdown("study", "a study: accuracy against time", [](core::Fields& fields) {
    StudyScene study;
    describe(fields, study);
  });
}

}  // namespace talus::study
