#include "coupler/regress/regression.hpp"

#include <algorithm>

#include "core/scene/reader.hpp"

namespace talus::coupler::regress {

void describe(core::Fields& fields, ColumnScene& column) {
  fields.required("contains", column.contains,
                  {.help = "a part of the columns' names, such as 'stone.spin'"});
  fields.required("relative", column.relative,
                  {.range = core::not_negative, .help = "the relative tolerance of these columns"});
}

void describe(core::Fields& fields, RegressionScene& regression) {
  fields.with_default("relative", regression.relative,
                      {.range = core::not_negative,
                       .help = "tolerance, as a part of the largest magnitude of the column or its vector"});
  fields.with_default("absolute", regression.absolute,
                      {.range = core::not_negative, .help = "added to it, in the column's SI unit"});
  fields.with_default("time_limit", regression.time_limit,
                      {.unit = "s",
                       .range = core::positive,
                       .help = "wall time after which the run is ended and counts as failed"});
  fields.list("columns", regression.columns, "other tolerances; the first entry that fits a column counts");
}

std::vector<Regression> find_regressions(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<Regression> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".yaml") continue;
    const auto file = core::SceneFile::load(entry.path());
    core::SceneReader reader(file, core::scene_sections());
    const auto tolerances = reader.required<RegressionScene>("regression");
    reader.finish();
    const std::string name = entry.path().stem();
    found.push_back({name, entry.path(), folder / "baselines" / name, tolerances});
  }
  if (found.empty()) throw core::ConfigError("no regressions (*.yaml) in '" + folder.string() + "'");
  std::ranges::sort(found, {}, &Regression::name);
  return found;
}

}  // namespace talus::coupler::regress
