#include "dem_solver/output/gate_tables.hpp"

#include <algorithm>

#include "dem_solver/output/sieve.hpp"

namespace talus::dem {

namespace {

const std::vector<std::string> passage_columns{"time_s", "stone", "diameter_m", "speed_m_per_s"};
const std::vector<std::string> size_columns{"diameter_from_m", "diameter_to_m", "spheres_passed",
                                            "spheres_held",    "rocks_passed",  "rocks_held"};
constexpr std::size_t tables_a_gate = 2;  // passages, then sizes

bool holds_sizes(std::size_t table) {
  return table % tables_a_gate == 1;
}

}  // namespace

GateTables::GateTables(const ParticleSolver& solver) : solver_(solver) {
  if (solver.gates().empty()) return;
  std::vector<int> sieve_of;
  const auto add = [&](Index number, bool is_rock, double radius) {
    stones_.push_back({number, is_rock});
    sieve_of.push_back(sieve_that_holds(2 * radius));
  };
  const Spheres& spheres = solver.spheres();
  for (Index id = 0; id < spheres.size(); ++id)
    if (const Index i = solver.place(id); !spheres.in_rock(i)) add(id, false, spheres.position[i].w);
  for (Index k = 0; k < solver.rocks().size(); ++k) add(k, true, solver.rocks().radius(k));
  sieves_ = sieve_of;
  std::ranges::sort(sieves_);
  sieves_.erase(std::unique(sieves_.begin(), sieves_.end()), sieves_.end());
  for (std::size_t k = 0; k < stones_.size(); ++k)
    stones_[k].size =
        static_cast<std::size_t>(std::ranges::lower_bound(sieves_, sieve_of[k]) - sieves_.begin());
}

std::vector<core::TableDescription> GateTables::descriptions() const {
  std::vector<core::TableDescription> tables;
  for (const Gate& gate : solver_.gates().gates()) {
    tables.push_back({.name = gate.name,
                      .columns = passage_columns,
                      .capacity = stones(),
                      .kind = core::TableKind::events});
    tables.push_back({.name = gate.name + ".sizes",
                      .columns = size_columns,
                      .capacity = static_cast<std::int64_t>(sieves_.size()),
                      .kind = core::TableKind::distribution});
  }
  return tables;
}

std::int64_t GateTables::rows(std::size_t table) const {
  if (holds_sizes(table)) return static_cast<std::int64_t>(sieves_.size());
  return static_cast<std::int64_t>(solver_.gates().passages(table / tables_a_gate).size());
}

void GateTables::fill(std::size_t table, std::int64_t first, std::span<double> values) const {
  const std::size_t gate = table / tables_a_gate;
  if (holds_sizes(table)) return fill_sizes(gate, values);
  fill_passages(std::span(solver_.gates().passages(gate)).subspan(static_cast<std::size_t>(first)), values);
}

void GateTables::fill_passages(std::span<const Passage> passages, std::span<double> values) {
  auto next = values.begin();
  for (const Passage& p : passages)
    for (const double value : {p.time, static_cast<double>(p.stone), p.diameter, p.speed}) *next++ = value;
}

void GateTables::fill_sizes(std::size_t gate, std::span<double> values) const {
  const auto row = [&](std::size_t size) { return values.data() + size * size_columns.size(); };
  std::ranges::fill(values, 0.0);
  for (std::size_t size = 0; size < sieves_.size(); ++size) {
    row(size)[0] = sieve_opening(sieves_[size]);
    row(size)[1] = sieve_opening(sieves_[size] + 1);
  }
  for (const Stone& stone : stones_) {
    const Gates& gates = solver_.gates();
    const bool held =
        stone.is_rock ? gates.holds_rock(gate, stone.number) : gates.holds_sphere(gate, stone.number);
    row(stone.size)[2 + (stone.is_rock ? 2 : 0) + (held ? 1 : 0)] += 1;
  }
}

}  // namespace talus::dem
