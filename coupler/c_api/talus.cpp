#include "coupler/c_api/talus.h"

#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "coupler/c_api/descriptions.hpp"
#include "coupler/c_api/given.hpp"
#include "coupler/participant.hpp"

using namespace talus;
using namespace talus::c_api;
using coupler::Action;

struct talus_participant {
  std::unique_ptr<coupler::Participant> participant;
  std::vector<mesh::SurfacePart> parts = {};
  coupler::Declaration declaration = {};  ///< what was added for it so far, then what was declared
  std::vector<core::Complaint> complaints = {};
  mesh::Surface boundary = {};
  std::vector<double> node_masses = {};
  std::string path = {};
};

static_assert(static_cast<int>(Action::advance) == TALUS_ADVANCE &&
              static_cast<int>(Action::finish) == TALUS_FINISH);
static_assert(static_cast<int>(coupler::Role::particles) == TALUS_PARTICLES);
static_assert(static_cast<int>(core::ExitCode::transport) == TALUS_TRANSPORT_ERROR &&
              static_cast<int>(core::ExitCode::numerical) == TALUS_NUMERICAL_ERROR &&
              static_cast<int>(core::ExitCode::machine) == TALUS_MACHINE_ERROR);
static_assert(static_cast<int>(core::LedgerKind::memo) == TALUS_MEMO);
static_assert(static_cast<int>(core::FieldLocation::cell) == TALUS_AT_CELLS);
static_assert(static_cast<int>(core::TableKind::distribution) == TALUS_DISTRIBUTION);

namespace {

thread_local std::string last_error;

/// No exception crosses into C: runs `call` and turns what it throws into a result and a text.
template <class Call>
talus_result guarded(Call&& call) noexcept {
  try {
    call();
    return TALUS_OK;
  } catch (const std::exception& error) {
    last_error = error.what();
    return static_cast<talus_result>(core::exit_code(error));
  }
}

coupler::Participant& participant_of(talus_participant* self) {
  return *given(self).participant;
}

/// The number of something that was added. @throws UsageError where there is none
template <class Item>
std::size_t index_in(const std::vector<Item>& items, std::int64_t index, const char* what) {
  if (index < 0 || index >= std::ssize(items))
    throw core::UsageError("there is no " + std::string(what) + " " + std::to_string(index) + "; there are " +
                           std::to_string(items.size()) + ", counted from 0");
  return static_cast<std::size_t>(index);
}

template <class Value>
Value* or_null(std::span<Value> values) {
  return values.empty() ? nullptr : values.data();
}

talus_surface surface_to(const mesh::Surface& surface, const std::vector<double>& node_masses) {
  return {.size = 0,
          .nodes = surface.node_count(),
          .positions = surface.positions.data(),
          .node_masses = node_masses.data(),
          .segments = std::ssize(surface.segments),
          .segment_nodes = surface.segments.empty() ? nullptr : surface.segments.front().data(),
          .triangles = std::ssize(surface.triangles),
          .triangle_nodes = surface.triangles.empty() ? nullptr : surface.triangles.front().data(),
          .start = surface.start.empty() ? nullptr : surface.start.data(),
          .parts = std::ssize(surface.parts)};
}

}  // namespace

talus_result talus_join(const char* segment, talus_role role, double timeout,
                        talus_participant** participant) {
  return guarded([&] {
    coupler::JoinOptions options{.segment = text(segment, "the segment to join"),
                                 .role = static_cast<coupler::Role>(role)};
    if (role != TALUS_STRUCTURE && role != TALUS_PARTICLES)
      throw core::UsageError("talus_join(): there is no role " + std::to_string(role));
    if (timeout > 0) options.timeout = timeout;
    given(participant) = new talus_participant{coupler::Participant::join(options)};
  });
}

talus_result talus_add_part(talus_participant* structure, const talus_part* part) {
  return guarded([&] { given(structure).parts.push_back(part_from(part)); });
}

talus_result talus_publish_surface(talus_participant* structure, const talus_surface* surface) {
  return guarded([&] {
    const talus_surface said = taken(surface, "talus_surface");
    participant_of(structure).publish_surface(
        surface_from(said, structure->parts),
        values(said.node_masses, said.nodes, 1, "talus_surface.node_masses"));
  });
}

talus_result talus_receive_surface(talus_participant* particles, talus_surface* boundary) {
  return guarded([&] {
    auto& self = given(particles);
    self.boundary = self.participant->receive_surface(self.node_masses);
    fill(boundary, "talus_surface", surface_to(self.boundary, self.node_masses));
  });
}

talus_result talus_get_part(talus_participant* particles, int64_t index, talus_part* part) {
  return guarded([&] {
    const auto& parts = given(particles).boundary.parts;
    const mesh::SurfacePart& found = parts[index_in(parts, index, "part")];
    fill(part, "talus_part",
         {.size = 0,
          .name = found.name.c_str(),
          .material = found.material.empty() ? nullptr : found.material.c_str(),
          .wire_radius = found.wire_radius,
          .segment_begin = found.segment_begin,
          .segment_end = found.segment_end,
          .triangle_begin = found.triangle_begin,
          .triangle_end = found.triangle_end});
  });
}

talus_result talus_add_limit(talus_participant* participant, const talus_limit* limit) {
  return guarded([&] { given(participant).declaration.limits.push_back(limit_from(limit)); });
}

talus_result talus_add_effect(talus_participant* participant, const talus_effect* effect) {
  return guarded([&] { given(participant).declaration.effects.push_back(effect_from(effect)); });
}

talus_result talus_add_probe(talus_participant* participant, const char* name, const char* watches) {
  return guarded([&] {
    given(participant)
        .declaration.outputs.probes.push_back(
            {.name = text(name, "the name of a probe"), .watches = optional_text(watches)});
  });
}

talus_result talus_add_ledger_line(talus_participant* participant, const char* name, talus_ledger_kind kind) {
  return guarded([&] {
    given(participant)
        .declaration.outputs.ledger.push_back(
            {.name = text(name, "the name of a ledger line"), .kind = static_cast<core::LedgerKind>(kind)});
  });
}

talus_result talus_add_group(talus_participant* participant, const talus_group* group) {
  return guarded([&] { given(participant).declaration.outputs.groups.push_back(group_from(group)); });
}

talus_result talus_add_field(talus_participant* participant, const talus_field* field) {
  return guarded([&] {
    const talus_field said = taken(field, "talus_field");
    auto& groups = given(participant).declaration.outputs.groups;
    groups[index_in(groups, said.group, "group")].fields.push_back(field_from(said));
  });
}

talus_result talus_add_table(talus_participant* participant, const talus_table* table) {
  return guarded([&] { given(participant).declaration.outputs.tables.push_back(table_from(table)); });
}

talus_result talus_add_fact(talus_participant* participant, const char* name, double value) {
  return guarded([&] {
    given(participant)
        .declaration.outputs.facts.push_back({.name = text(name, "the name of a fact"), .value = value});
  });
}

talus_result talus_add_warning(talus_participant* participant, const char* warning) {
  return guarded([&] { given(participant).declaration.warnings.push_back(text(warning, "a warning")); });
}

talus_result talus_declare(talus_participant* participant, const talus_declaration* declaration) {
  return guarded([&] {
    auto& self = given(participant);
    const coupler::Declaration whole = declaration_from(declaration, self.declaration);
    self.participant->declare(whole);
  });
}

talus_result talus_next(talus_participant* participant, talus_command* command) {
  return guarded([&] {
    auto& self = given(participant);
    said_size(given(command), "talus_command");  // a command that was taken could not be answered
    const coupler::Command next = self.participant->next();
    self.path = next.path;
    fill(command, "talus_command",
         {.size = 0,
          .action = static_cast<talus_action>(next.action),
          .fields = next.fields ? 1 : 0,
          .window = next.window,
          .iteration = next.iteration,
          .tentative = next.tentative ? 1 : 0,
          .time = next.time,
          .length = next.length,
          .regular_length = next.regular_length,
          .force_shift = next.force_shift,
          .path = self.path.c_str()});
  });
}

talus_result talus_answer(talus_participant* participant) {
  return guarded([&] { participant_of(participant).answer(); });
}

talus_result talus_get_structure_fields(talus_participant* structure, talus_structure_fields* fields) {
  return guarded([&] {
    const coupler::StructureFields views = participant_of(structure).structure_fields();
    fill(fields, "talus_structure_fields",
         {.size = 0,
          .force = views.force.data(),
          .displacement = views.displacement.data(),
          .velocity = views.velocity.data(),
          .free_velocity = or_null(views.free_velocity),
          .lost = or_null(views.lost)});
  });
}

talus_result talus_get_particle_fields(talus_participant* particles, talus_particle_fields* fields) {
  return guarded([&] {
    const coupler::ParticleFields views = participant_of(particles).particle_fields();
    fill(fields, "talus_particle_fields",
         {.size = 0,
          .start_displacement = views.start_displacement.data(),
          .start_velocity = views.start_velocity.data(),
          .end_displacement = or_null(views.end_displacement),
          .end_velocity = or_null(views.end_velocity),
          .force = views.force.data(),
          .free_velocity = or_null(views.free_velocity),
          .moved_displacement = or_null(views.moved_displacement),
          .moved_velocity = or_null(views.moved_velocity),
          .lost = or_null(views.lost)});
  });
}

talus_result talus_get_probes(talus_participant* participant, double** values) {
  return guarded([&] { given(values) = participant_of(participant).probes().data(); });
}

talus_result talus_get_ledger(talus_participant* participant, double** joules) {
  return guarded([&] { given(joules) = participant_of(participant).ledger().data(); });
}

talus_result talus_get_positions(talus_participant* participant, int64_t group, double** positions) {
  return guarded([&] {
    const auto& groups = given(participant).declaration.outputs.groups;
    given(positions) = participant->participant->positions(index_in(groups, group, "group")).data();
  });
}

talus_result talus_get_field(talus_participant* participant, int64_t group, int64_t field, double** values) {
  return guarded([&] {
    const auto& groups = given(participant).declaration.outputs.groups;
    const std::size_t of = index_in(groups, group, "group");
    given(values) = participant->participant->field(of, index_in(groups[of].fields, field, "field")).data();
  });
}

talus_result talus_get_table(talus_participant* participant, int64_t table, double** values, double** rows) {
  return guarded([&] {
    const std::size_t of = index_in(given(participant).declaration.outputs.tables, table, "table");
    given(values) = participant->participant->table(of).data();
    given(rows) = &participant->participant->table_rows(of);
  });
}

talus_result talus_tell_force_evaluations(talus_participant* participant, int64_t since_start) {
  return guarded([&] { participant_of(participant).tell_force_evaluations(since_start); });
}

talus_result talus_book_work(talus_participant* participant, double of_this_window) {
  return guarded([&] { participant_of(participant).book_work(of_this_window); });
}

talus_result talus_checkpoint_state(const talus_command* command, void* state, size_t bytes) {
  return guarded([&] {
    const talus_command said = taken(command, "talus_command");
    coupler::Command about;
    about.action = static_cast<Action>(said.action);
    about.path = optional_text(said.path);
    coupler::checkpoint_state(about, {static_cast<std::byte*>(state), bytes});
  });
}

void talus_fail(talus_participant* participant, const char* reason) {
  guarded([&] { participant_of(participant).fail(std::runtime_error(optional_text(reason))); });
}

talus_result talus_add_complaint(talus_participant* participant, const talus_complaint* complaint) {
  return guarded([&] { given(participant).complaints.push_back(complaint_from(complaint)); });
}

void talus_fail_config(talus_participant* participant) {
  guarded([&] { participant_of(participant).fail(core::ConfigError(participant->complaints)); });
}

void talus_fail_numerical(talus_participant* participant, const talus_numerical_details* error) {
  guarded([&] { participant_of(participant).fail(core::NumericalError(numerical_error_from(error))); });
}

void talus_fail_machine(talus_participant* participant, const char* reason) {
  guarded([&] { participant_of(participant).fail(core::MachineError(optional_text(reason))); });
}

void talus_leave(talus_participant* participant) {
  delete participant;
}

const char* talus_last_error(void) {
  return last_error.c_str();
}
