#include "dem_solver/output/particle_output.hpp"

#include <algorithm>
#include <numeric>

namespace talus::dem {

using core::FieldLocation;
using core::LedgerKind;

ParticleOutput::ParticleOutput(const ParticleSolver& solver, NamedBodies named,
                               std::vector<mesh::Surface> rock_surfaces, const core::StageClock* clock)
    : solver_(solver),
      named_(std::move(named)),
      rock_surfaces_(std::move(rock_surfaces)),
      gates_(solver),
      clock_(clock) {
  describe_probes();
  if (clock_) clock_->describe(description_.probes);
  if (solver_.law().ledger) describe_ledger();
  describe_particles();
  describe_rocks();
  if (!solver_.boundary().empty()) describe_boundary();
  description_.tables = gates_.descriptions();
  description_.facts = named_.facts;
}

void ParticleOutput::describe_probes() {
  const auto add_vector = [this](const std::string& name, const std::string& unit) {
    for (const char* axis : {"_x_", "_y_", "_z_"}) description_.probes.push_back({name + axis + unit});
  };
  const auto add_body = [&](const std::string& name, bool turns) {
    add_vector(name + ".position", "m");
    add_vector(name + ".velocity", "m_per_s");
    if (turns) add_vector(name + ".spin", "rad_per_s");
    add_vector(name + ".contact_force", "N");
    description_.probes.push_back({name + ".kinetic_energy_J"});
  };
  for (const auto& [name, id] : named_.spheres) add_body(name, solver_.spheres().rotates());
  for (const auto& [name, k] : named_.rocks) add_body(name, true);
  for (const Gate& gate : solver_.gates().gates())
    for (const char* quantity : {".stones_passed", ".mass_passed_kg", ".energy_passed_J",
                                 ".smallest_radius_m", ".largest_radius_m", ".stones_held"})
      description_.probes.push_back({gate.name + quantity});
}

void ParticleOutput::describe_ledger() {
  description_.ledger = {{"particles.kinetic_J", LedgerKind::stored},
                         {"particles.kinetic_rotation_J", LedgerKind::stored},
                         {"contacts.elastic_J", LedgerKind::stored},
                         {"contacts.damping_J", LedgerKind::dissipated},
                         {"contacts.friction_J", LedgerKind::dissipated},
                         {"particles.gravity_J", LedgerKind::supplied},
                         {"particles.boundary_work_J", LedgerKind::supplied}};
}

void ParticleOutput::describe_particles() {
  core::GroupDescription particles{
      .name = "particles",
      .kind = core::CellKind::vertex,
      .nodes = solver_.spheres().size(),
      .cells = {},
      .fields = {{"radius", "m", 1, FieldLocation::node}, {"velocity", "m/s", 3, FieldLocation::node}}};
  particles.cells.resize(static_cast<std::size_t>(particles.nodes));
  std::iota(particles.cells.begin(), particles.cells.end(), 0);
  if (solver_.spheres().rotates()) particles.fields.push_back({"spin", "rad/s", 3, FieldLocation::node});
  description_.groups.push_back(std::move(particles));
  groups_.push_back(Group::particles);
}

void ParticleOutput::describe_rocks() {
  core::GroupDescription rocks{
      .name = "rocks", .kind = core::CellKind::triangle, .nodes = 0, .cells = {}, .fields = {}};
  for (const mesh::Surface& surface : rock_surfaces_) {
    for (const auto& triangle : surface.triangles)
      for (mesh::Index node : triangle) rocks.cells.push_back(node + rocks.nodes);
    rocks.nodes += surface.node_count();
  }
  if (rocks.cells.empty()) return;
  description_.groups.push_back(std::move(rocks));
  groups_.push_back(Group::rocks);
}

void ParticleOutput::describe_boundary() {
  core::GroupDescription wires{.name = "boundary_wires",
                               .kind = core::CellKind::segment,
                               .nodes = solver_.boundary().node_count(),
                               .cells = {},
                               .fields = {{"contact_force", "N", 3, FieldLocation::node}}};
  core::GroupDescription faces = wires;
  faces.name = "boundary_faces";
  faces.kind = core::CellKind::triangle;
  for (const Feature& f : solver_.boundary().features()) {
    auto& cells = f.is_segment() ? wires.cells : faces.cells;
    cells.insert(cells.end(), f.nodes.begin(), f.nodes.end() - (f.is_segment() ? 1 : 0));
  }
  if (!wires.cells.empty()) {
    description_.groups.push_back(std::move(wires));
    groups_.push_back(Group::wires);
  }
  if (!faces.cells.empty()) {
    description_.groups.push_back(std::move(faces));
    groups_.push_back(Group::faces);
  }
}

void ParticleOutput::fill_probes(std::span<double> values) const {
  auto next = values.begin();
  const auto put = [&next](const auto& r) {
    for (double component : {r.x, r.y, r.z}) *next++ = component;
  };
  const auto energy = [](double mass, const Triple<double>& v) { return 0.5 * mass * dot(v, v); };
  const Spheres& s = solver_.spheres();
  for (const auto& [name, id] : named_.spheres) {
    const Index i = solver_.place(id);
    put(s.position[i]);
    put(s.velocity[i]);
    if (s.rotates()) put(s.spin[i]);
    put(s.force[i]);
    *next++ = energy(s.velocity[i].w, triple<double>(s.velocity[i]));
  }
  const Rocks& rocks = solver_.rocks();
  for (const auto& [name, k] : named_.rocks) {
    put(rocks.centre(k));
    put(rocks.velocity(k));
    put(rocks.spin(k));
    put(rocks.force(k));
    *next++ = energy(rocks.mass(k), rocks.velocity(k)) + 0.5 * dot(rocks.spin(k), rocks.angular_momentum(k));
  }
  for (const Passed& passed : solver_.gates().passed())
    for (double value :
         {static_cast<double>(passed.stones), passed.mass, passed.kinetic_energy, passed.smallest_radius,
          passed.largest_radius, static_cast<double>(gates_.stones() - passed.stones)})
      *next++ = value;
  if (clock_) std::ranges::copy(clock_->seconds(), next);
}

void ParticleOutput::fill_ledger(std::span<double> joules) const {
  if (joules.empty()) return;
  const ParticleLedger l = solver_.ledger();
  const double lines[] = {l.kinetic, l.rotation, l.elastic, l.damping, l.friction, l.gravity, l.boundary};
  std::ranges::copy(lines, joules.begin());
}

namespace {
void put_triple(const Triple<double>& t, double* to) {
  to[0] = t.x;
  to[1] = t.y;
  to[2] = t.z;
}

/// value(node) of every node of the boundary.
template <class Value>
void put_by_node(const Boundary& boundary, const Value& value, std::span<double> values) {
  for (Index i = 0; i < boundary.node_count(); ++i)
    put_triple(value(i), values.data() + 3 * static_cast<std::size_t>(i));
}

/// In the order the spheres were added, whatever the solver's own order is.
void put_by_id(const Spheres& spheres, std::span<const Row> rows, std::span<double> values) {
  for (Index i = 0; i < spheres.size(); ++i)
    put_triple(triple<double>(rows[i]), values.data() + 3 * static_cast<std::size_t>(spheres.id[i]));
}
}  // namespace

void ParticleOutput::fill_rock_surfaces(std::span<double> positions) const {
  auto next = positions.begin();
  for (Index k = 0; k < solver_.rocks().size(); ++k) {
    const std::vector<double>& in_rock = rock_surfaces_[k].positions;
    for (std::size_t i = 0; i < in_rock.size(); i += 3) {
      const Triple<double> arm{in_rock[i], in_rock[i + 1], in_rock[i + 2]};
      const Triple<double> p = solver_.rocks().centre(k) + rotate(solver_.rocks().orientation(k), arm);
      for (double component : {p.x, p.y, p.z}) *next++ = component;
    }
  }
}

void ParticleOutput::fill_positions(std::size_t group, std::span<double> positions) const {
  switch (groups_[group]) {
    case Group::particles:
      return put_by_id(solver_.spheres(), solver_.spheres().position, positions);
    case Group::rocks:
      return fill_rock_surfaces(positions);
    case Group::wires:
    case Group::faces:
      return put_by_node(
          solver_.boundary(), [this](Index i) { return solver_.boundary().position(i); }, positions);
  }
}

void ParticleOutput::fill_field(std::size_t group, std::size_t field, std::span<double> values) const {
  const Spheres& s = solver_.spheres();
  const Boundary& boundary = solver_.boundary();
  if (groups_[group] != Group::particles)
    return put_by_node(
        boundary, [&](Index i) { return triple<double>(boundary.reaction()[i]); }, values);
  if (field == 1) return put_by_id(s, s.velocity, values);
  if (field == 2) return put_by_id(s, s.spin, values);
  for (Index i = 0; i < s.size(); ++i) values[s.id[i]] = s.position[i].w;
}

}  // namespace talus::dem
