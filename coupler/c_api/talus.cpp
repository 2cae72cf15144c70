#include "coupler/c_api/talus.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "coupler/participant.hpp"

struct talus_participant {
  std::unique_ptr<talus::coupler::Participant> real;
  talus::mesh::Surface boundary;
  std::vector<double> boundary_masses;
  std::string message;
};

namespace {

using namespace talus;

thread_local std::string join_message;

/// Runs one call; what it throws becomes a status and a message.
template <class Call>
talus_status guarded(std::string& message, Call&& call) noexcept {
  try {
    call();
    return TALUS_OK;
  } catch (const core::TransportError& error) {
    message = error.what();
    return TALUS_TRANSPORT_ERROR;
  } catch (const std::exception& error) {
    message = error.what();
    return TALUS_USAGE_ERROR;
  }
}

mesh::Surface surface_of(const talus_surface& given) {
  mesh::Surface surface;
  surface.positions.assign(given.positions, given.positions + 3 * given.nodes);
  for (std::size_t i = 0; i < given.segments; ++i) {
    surface.segments.push_back({given.segment_nodes[2 * i], given.segment_nodes[2 * i + 1]});
  }
  surface.parts.push_back({.name = given.part, .segment_end = static_cast<mesh::Index>(given.segments)});
  return surface;
}

const double* start_or_null(std::span<const double> values) {
  return values.empty() ? nullptr : values.data();
}

static_assert(static_cast<int>(coupler::Action::finish) == TALUS_FINISH);
static_assert(static_cast<int>(coupler::Action::report) == TALUS_REPORT);
static_assert(static_cast<int>(coupler::Role::particles) == TALUS_PARTICLES);

}  // namespace

extern "C" {

talus_participant* talus_join(const char* segment, talus_role role) {
  auto participant = std::make_unique<talus_participant>();
  const talus_status status = guarded(join_message, [&] {
    participant->real =
        coupler::Participant::join({.segment = segment, .role = static_cast<coupler::Role>(role)});
  });
  return status == TALUS_OK ? participant.release() : nullptr;
}

void talus_leave(talus_participant* participant) {
  delete participant;
}

const char* talus_message(const talus_participant* participant) {
  return participant == nullptr ? join_message.c_str() : participant->message.c_str();
}

talus_status talus_publish_surface(talus_participant* p, const talus_surface* surface,
                                   const double* node_masses) {
  return guarded(p->message, [&] {
    p->real->publish_surface(surface_of(*surface), {node_masses, surface->nodes});
  });
}

talus_status talus_receive_surface(talus_participant* p, size_t* nodes) {
  return guarded(p->message, [&] {
    p->boundary = p->real->receive_surface(p->boundary_masses);
    *nodes = p->boundary_masses.size();
  });
}

talus_status talus_boundary(const talus_participant* p, double* positions, double* node_masses) {
  std::copy(p->boundary.positions.begin(), p->boundary.positions.end(), positions);
  std::copy(p->boundary_masses.begin(), p->boundary_masses.end(), node_masses);
  return TALUS_OK;
}

talus_status talus_declare(talus_participant* p, const char* program, double step) {
  return guarded(p->message, [&] { p->real->declare({.program = program, .step = step}); });
}

talus_status talus_next(talus_participant* p, talus_command* command) {
  return guarded(p->message, [&] {
    const coupler::Command next = p->real->next();
    *command = {.action = static_cast<talus_action>(next.action),
                .window = next.window,
                .time = next.time,
                .length = next.length};
  });
}

talus_status talus_answer(talus_participant* p) {
  return guarded(p->message, [&] { p->real->answer(); });
}

void talus_fail(talus_participant* p, const char* reason) {
  p->real->fail(std::runtime_error(reason));
}

talus_status talus_get_structure_fields(talus_participant* p, talus_structure_fields* fields) {
  return guarded(p->message, [&] {
    const auto real = p->real->structure_fields();
    *fields = {.nodes = real.force.size() / 3,
               .force = real.force.data(),
               .displacement = real.displacement.data(),
               .velocity = real.velocity.data()};
  });
}

talus_status talus_get_particle_fields(talus_participant* p, talus_particle_fields* fields) {
  return guarded(p->message, [&] {
    const auto real = p->real->particle_fields();
    *fields = {.nodes = real.force.size() / 3,
               .start_displacement = real.start_displacement.data(),
               .start_velocity = real.start_velocity.data(),
               .end_displacement = start_or_null(real.end_displacement),
               .end_velocity = start_or_null(real.end_velocity),
               .force = real.force.data()};
  });
}

}  // extern "C"
