#include "fem_solver/integration/force_record.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fem {
namespace {

/// Columns of `largest_forces` and `support_forces`, as places in a row.
enum ForceColumn : std::size_t { tension, tension_time, compression, compression_time, force_columns };
enum SupportColumn : std::size_t { magnitude, along_x, along_y, along_z, support_time, support_columns };
/// Of `utilisation` and `buckling`.
enum UsedColumn : std::size_t { used_force, breaking_load, utilisation, used_columns };
enum RuptureColumn : std::size_t {
  broken,
  first_element,
  first_time,
  first_force,
  at_x,
  at_y,
  at_z,
  rupture_columns
};

/// visit(axial force in N) for every element of a batch that has one.
template <class Batch, class Visit>
void for_each_axial_force(const Batch& batch, const Configuration& at, const Visit& visit) {
  if constexpr (requires { batch.axial_force(at, Index{}); })
    for (Index e = 0; e < batch.size(); ++e) visit(batch.axial_force(at, e));
  else if constexpr (requires { batch.tension(at, Index{}); })
    for (Index e = 0; e < batch.line().segments(); ++e) visit(batch.tension(at, e));
  else if constexpr (requires { batch.tension(at); })
    visit(batch.tension(at));
}
template <class Batch>
constexpr bool has_axial_force = requires(const Batch& batch, const Configuration& at) {
  batch.axial_force(at, Index{});
}
|| requires(const Batch& batch, const Configuration& at) {
  batch.tension(at, Index{});
}
|| requires(const Batch& batch, const Configuration& at) {
  batch.tension(at);
};

/// Keeps the larger of two, and when it was.
void keep_largest(double value, double time, double& largest, double& at) {
  if (value > largest) largest = value, at = time;
}

/// Two supports may have the same name.
std::string new_name(const std::string& name, const std::vector<std::string>& taken) {
  std::string chosen = name;
  for (int k = 2; std::ranges::find(taken, chosen) != taken.end(); ++k)
    chosen = name + "_" + std::to_string(k);
  return chosen;
}

/// Elements that break in this step.
template <Breaks Batch>
void note_ruptures(const Model& model, const Batch& batch, double time, const Configuration& at,
                   const Configuration& after, std::span<double> row) {
  for (Index e = 0; e < batch.size(); ++e) {
    if (batch.is_broken(at, e) || !batch.is_broken(after, e)) continue;
    row[broken] += 1;
    if (row[broken] > 1) continue;
    const auto [near, far] = batch.cells()[static_cast<std::size_t>(first_cell(batch, e))];
    const auto place = [&](Index node) {
      return Vector3(model.position(node) +
                     Vector3::Map(&at.displacement[3 * static_cast<std::size_t>(node)]));
    };
    const Vector3 middle = 0.5 * (place(near) + place(far));
    row[first_element] = e;
    row[first_time] = time;
    row[first_force] = batch.axial_force(at, e);
    row[at_x] = middle.x();
    row[at_y] = middle.y();
    row[at_z] = middle.z();
  }
}

}  // namespace

ForceRecord::ForceRecord(const Model& model)
    : model_(model),
      forces_{
          "largest_forces", {"tension_N", "tension_time_s", "compression_N", "compression_time_s"}, {}, 0},
      supports_{"support_forces", {"force_N", "x_N", "y_N", "z_N", "time_s"}, {}, 0},
      ruptures_{
          "ruptures",
          {"broken", "first_element", "first_time_s", "first_force_N", "first_x_m", "first_y_m", "first_z_m"},
          {},
          0},
      utilisation_{"utilisation", {"force_N", "breaking_load_N", "utilisation"}, {}, 0},
      buckling_{"buckling", {"compression_N", "buckling_load_N", "utilisation"}, {}, 0} {
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    std::visit(
        [&](const auto& batch) {
          using Batch = std::decay_t<decltype(batch)>;
          if constexpr (has_axial_force<Batch>) forces_.rows.push_back(model.parts[p].name);
          if constexpr (Breaks<Batch>) ruptures_.rows.push_back(model.parts[p].name);
        },
        model.parts[p].elements);
  for (const Part& part : model.parts) {
    if (part.breaking_load > 0) utilisation_.rows.push_back(part.name);
    if (part.buckling_load > 0) buckling_.rows.push_back(part.name);
  }
  for (const Support& support : model.supports)
    supports_.rows.push_back(new_name(support.name, supports_.rows));
  supports_.begin = forces_.values();
  ruptures_.begin = supports_.begin + supports_.values();
  utilisation_.begin = ruptures_.begin + ruptures_.values();
  buckling_.begin = utilisation_.begin + utilisation_.values();
}

std::vector<double> ForceRecord::begin() const {
  return std::vector<double>(buckling_.begin + buckling_.values(), 0.0);
}

void ForceRecord::note_elements(double time, const Configuration& at, std::span<const double> next,
                                std::span<double> record) const {
  std::size_t force_row = 0, rupture_row = 0, used_row = 0, pressed_row = 0, memory = 0;
  for_each_part(model_, at, [&](std::size_t p, const auto& batch, const Configuration& own) {
    using Batch = std::decay_t<decltype(batch)>;
    const std::size_t remembered = memory_size_of(batch);
    if constexpr (has_axial_force<Batch>) {
      double* row = &record[forces_.begin + force_columns * force_row++];
      for_each_axial_force(batch, own, [&](double force) {
        keep_largest(force, time, row[tension], row[tension_time]);
        keep_largest(-force, time, row[compression], row[compression_time]);
      });
      const auto use = [&](double force, double load, double* used) {
        used[used_force] = force;
        used[breaking_load] = load;
        used[utilisation] = force / load;
      };
      const Part& part = model_.parts[p];
      if (part.breaking_load > 0)
        use(std::max(row[tension], row[compression]), part.breaking_load,
            &record[utilisation_.begin + used_columns * used_row++]);
      if (part.buckling_load > 0)
        use(row[compression], part.buckling_load, &record[buckling_.begin + used_columns * pressed_row++]);
    }
    if constexpr (Breaks<Batch>)
      note_ruptures(model_, batch, time, own, {own.displacement, next.subspan(memory, remembered)},
                    record.subspan(ruptures_.begin + rupture_columns * rupture_row++, rupture_columns));
    memory += remembered;
  });
}

void ForceRecord::note_supports(double time, std::span<const double> reactions,
                                std::span<double> record) const {
  const double* reaction = reactions.data();
  double* row = record.data() + supports_.begin;
  for (const Support& support : model_.supports) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < support.nodes.size(); ++k, reaction += 3) sum += Vector3::Map(reaction);
    if (const double force = sum.norm(); force > row[magnitude]) {
      row[magnitude] = force;
      row[along_x] = sum.x();
      row[along_y] = sum.y();
      row[along_z] = sum.z();
      row[support_time] = time;
    }
    row += support_columns;
  }
}

std::vector<ForceRecord::Table> ForceRecord::tables() const {
  std::vector<Table> tables;
  for (const Table* table : {&forces_, &supports_, &ruptures_, &utilisation_, &buckling_})
    if (!table->rows.empty()) tables.push_back(*table);
  return tables;
}

}  // namespace talus::fem
