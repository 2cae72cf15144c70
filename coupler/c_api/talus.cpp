#include "coupler/c_api/talus.h"

#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "coupler/participant.hpp"

using namespace talus;
using coupler::Action;

struct talus_participant {
  std::unique_ptr<coupler::Participant> participant;
  mesh::Surface boundary = {};
  std::vector<double> node_masses = {};
  std::string path = {};
};

static_assert(static_cast<int>(Action::advance) == TALUS_ADVANCE &&
              static_cast<int>(Action::finish) == TALUS_FINISH);
static_assert(static_cast<int>(coupler::Role::particles) == TALUS_PARTICLES);
static_assert(static_cast<int>(core::ExitCode::transport) == TALUS_TRANSPORT_ERROR);

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
    const core::ExitCode code = core::exit_code(error);
    if (code == core::ExitCode::transport) return TALUS_TRANSPORT_ERROR;
    return code == core::ExitCode::config ? TALUS_CONFIG_ERROR : TALUS_USAGE_ERROR;
  }
}

template <class Pointer>
auto& given(Pointer* pointer) {
  if (pointer == nullptr) throw core::UsageError("an argument is NULL");
  return *pointer;
}

template <std::size_t nodes>
std::vector<std::array<mesh::Index, nodes>> cells(const std::int32_t* values, std::int64_t count) {
  std::vector<std::array<mesh::Index, nodes>> made(static_cast<std::size_t>(count));
  for (auto& cell : made) {
    for (auto& node : cell) node = *values++;
  }
  return made;
}

mesh::Surface surface_from(const talus_surface& s) {
  mesh::Surface surface{.positions = {s.positions, s.positions + 3 * s.nodes},
                        .segments = cells<2>(s.segment_nodes, s.segments),
                        .triangles = cells<3>(s.triangle_nodes, s.triangles)};
  surface.parts = {{.name = "surface",
                    .segment_end = static_cast<mesh::Index>(s.segments),
                    .triangle_end = static_cast<mesh::Index>(s.triangles)}};
  return surface;
}

talus_surface surface_to(const mesh::Surface& surface, const std::vector<double>& node_masses) {
  return {.nodes = surface.node_count(),
          .positions = surface.positions.data(),
          .node_masses = node_masses.data(),
          .segments = static_cast<std::int64_t>(surface.segments.size()),
          .segment_nodes = surface.segments.empty() ? nullptr : surface.segments.front().data(),
          .triangles = static_cast<std::int64_t>(surface.triangles.size()),
          .triangle_nodes = surface.triangles.empty() ? nullptr : surface.triangles.front().data()};
}

coupler::Declaration declaration_from(const talus_declaration& said) {
  coupler::Declaration declaration;
  declaration.program = said.program;
  declaration.step = said.step;
  declaration.checkpoints = said.checkpoints != 0;
  declaration.force_use = said.force_is_load != 0 ? coupler::ForceUse::load : coupler::ForceUse::kicks;
  if (said.stable_step > 0) {
    declaration.limits = {
        {.name = "largest stable step", .seconds = said.stable_step, .reason = "named by the program"}};
  }
  for (std::int64_t i = 0; i < said.probes; ++i)
    declaration.outputs.probes.push_back({.name = said.probe_names[i]});
  return declaration;
}

}  // namespace

talus_result talus_join(const char* segment, talus_role role, talus_participant** participant) {
  return guarded([&] {
    given(participant) = new talus_participant{
        coupler::Participant::join({.segment = &given(segment), .role = static_cast<coupler::Role>(role)})};
  });
}

talus_result talus_publish_surface(talus_participant* structure, const talus_surface* surface) {
  return guarded([&] {
    const talus_surface& given_surface = given(surface);
    const auto nodes = static_cast<std::size_t>(given_surface.nodes);
    given(structure).participant->publish_surface(surface_from(given_surface),
                                                  {given_surface.node_masses, nodes});
  });
}

talus_result talus_receive_surface(talus_participant* particles, talus_surface* boundary) {
  return guarded([&] {
    auto& self = given(particles);
    self.boundary = self.participant->receive_surface(self.node_masses);
    given(boundary) = surface_to(self.boundary, self.node_masses);
  });
}

talus_result talus_declare(talus_participant* participant, const talus_declaration* declaration) {
  return guarded([&] { given(participant).participant->declare(declaration_from(given(declaration))); });
}

talus_result talus_next(talus_participant* participant, talus_command* command) {
  return guarded([&] {
    auto& self = given(participant);
    const coupler::Command next = self.participant->next();
    self.path = next.path;
    given(command) = {.action = static_cast<talus_action>(next.action),
                      .fields = next.fields ? 1 : 0,
                      .window = next.window,
                      .iteration = next.iteration,
                      .time = next.time,
                      .length = next.length,
                      .force_shift = next.force_shift,
                      .path = self.path.c_str()};
  });
}

talus_result talus_answer(talus_participant* participant) {
  return guarded([&] { given(participant).participant->answer(); });
}

talus_result talus_get_structure_fields(talus_participant* structure, talus_structure_fields* fields) {
  return guarded([&] {
    const auto views = given(structure).participant->structure_fields();
    given(fields) = {views.force.data(), views.displacement.data(), views.velocity.data()};
  });
}

talus_result talus_get_particle_fields(talus_participant* particles, talus_particle_fields* fields) {
  return guarded([&] {
    const auto views = given(particles).participant->particle_fields();
    const auto or_null = [](std::span<const double> values) {
      return values.empty() ? nullptr : values.data();
    };
    given(fields) = {views.start_displacement.data(), views.start_velocity.data(),
                     or_null(views.end_displacement), or_null(views.end_velocity), views.force.data()};
  });
}

talus_result talus_get_probes(talus_participant* participant, double** values) {
  return guarded([&] { given(values) = given(participant).participant->probes().data(); });
}

talus_result talus_checkpoint_state(const talus_command* command, void* state, size_t bytes) {
  return guarded([&] {
    coupler::Command about;
    about.action = static_cast<Action>(given(command).action);
    about.path = given(command).path;
    coupler::checkpoint_state(about, {static_cast<std::byte*>(state), bytes});
  });
}

void talus_fail(talus_participant* participant, const char* reason) {
  if (participant != nullptr)
    participant->participant->fail(std::runtime_error(reason == nullptr ? "" : reason));
}

void talus_leave(talus_participant* participant) {
  delete participant;
}

const char* talus_last_error(void) {
  return last_error.c_str();
}
