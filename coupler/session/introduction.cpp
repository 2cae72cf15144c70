#include "coupler/session/introduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/steps.hpp"

namespace talus::coupler {
namespace {

using transport::ArrayName;
using transport::MessageKind;

/// Complaints about one scene from several programs. Sections that all of them read are complained about
/// once.
class Complaints {
 public:
  explicit Complaints(std::vector<core::Complaint> first) : all_(std::move(first)) {}

  template <class Step>
  void collect(Step&& step) {
    try {
      step();
    } catch (const core::ConfigError& error) {
      all_.insert(all_.end(), error.complaints().begin(), error.complaints().end());
    }
  }
  void throw_if_any() {
    if (all_.empty()) return;
    const auto place = [](const core::Complaint& c) {
      return std::tie(c.file, c.line, c.column, c.key_path, c.message);
    };
    std::sort(all_.begin(), all_.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
    throw core::ConfigError(std::move(all_));
  }

 private:
  std::vector<core::Complaint> all_;
};

ByteView expect(const transport::Message& message, MessageKind kind, const Peer& peer, const char* what) {
  if (message.kind == kind) return message.bytes;
  throw core::TransportError({.peer = peer.label(), .waited_for = what, .reason = "said something else"});
}

PublishedSurface hear_surface(Session& session, Peer& structure) {
  const auto message = session.receive(structure, "its surface");
  return decode_surface(expect(message, MessageKind::surface, structure, "its surface"), structure.label());
}

void hear_request(Session& session, Peer& particles) {
  expect(session.receive(particles, "it to ask for its boundary"), MessageKind::surface_request, particles,
         "it to ask for its boundary");
}

Interface make_interface(const InterfacePlan& plan, PublishedSurface published) {
  mesh::Surface boundary = plan.make_boundary(published.surface);
  mesh::TiedSurfaces tie = plan.tie(boundary, published.surface);
  boundary.start.clear();
  if (!published.surface.start.empty()) {
    boundary.start.resize(boundary.positions.size());
    tie.mapping.to_boundary(published.surface.start, boundary.start);
  }
  std::vector<double> boundary_masses = tie.mapping.boundary_masses(published.node_masses);
  return {.structure = std::move(published.surface),
          .boundary = std::move(boundary),
          .structure_masses = std::move(published.node_masses),
          .boundary_masses = std::move(boundary_masses),
          .tie = std::move(tie)};
}

void refuse_heavy_boundary(const Peer& particles) {
  if (particles.declaration().light_boundary) return;
  throw core::ConfigError(fmt::format(
      "coupling.serial_implicit.relax: 'free_motion' needs particles that move the boundary's light "
      "nodes with the contact forces; {} does not",
      particles.declaration().program));
}

}  // namespace

namespace {

/// Which cell of Ω_D goes with a cell of Ω_S is known only where they are the same.
void refuse_other_cells(const Interface& interface) {
  if (interface.boundary.segments == interface.structure.segments &&
      interface.boundary.triangles == interface.structure.triangles)
    return;
  throw core::ConfigError(
      "interface.boundary: the structure may lose elements (`breaks`), and so must the boundary: write "
      "`same_as_structure`");
}

}  // namespace

InterfacePlan identical_surfaces() {
  return {.make_boundary = [](const mesh::Surface& structure) { return structure; },
          .tie =
              [](const mesh::Surface& boundary, const mesh::Surface& structure) {
                return mesh::tie_to_nearest_feature(boundary, structure);
              }};
}

std::optional<Interface> introduce(Session& session, const std::optional<InterfacePlan>& plan,
                                   std::vector<core::Complaint> complaints) {
  Complaints all(std::move(complaints));
  Peer* structure = session.find(Role::structure);
  Peer* particles = session.find(Role::particles);
  PublishedSurface published;
  if (structure != nullptr) all.collect([&] { published = hear_surface(session, *structure); });
  if (particles != nullptr) all.collect([&] { hear_request(session, *particles); });
  all.throw_if_any();

  std::optional<Interface> interface;
  if (plan && structure != nullptr && particles != nullptr)
    interface = make_interface(*plan, std::move(published));
  if (particles != nullptr) {
    const PublishedSurface boundary =
        interface ? PublishedSurface{interface->boundary, interface->boundary_masses} : PublishedSurface{};
    session.send(*particles, MessageKind::surface, encode(boundary));
  }
  for (Peer* peer : session.peers()) {
    all.collect([&] {
      const auto message = session.receive(*peer, "its declaration");
      peer->set_declaration(decode_declaration(
          expect(message, MessageKind::declaration, *peer, "its declaration"), peer->label()));
    });
  }
  all.throw_if_any();
  return interface;
}

bool needs_free_velocity(Session& session, double window_length) {
  const Peer *structure = session.find(Role::structure), *particles = session.find(Role::particles);
  if (!structure || !particles || !particles->declaration().free_velocity) return false;
  for (const Peer* peer : {structure, particles})
    if (peer->declaration().takes_several_steps(window_length))
      throw core::ConfigError(
          fmt::format("particles.implicit_contact wants one step a window, but {} takes steps of {:g} s in "
                      "windows of {:g} s",
                      peer->declaration().program, peer->declaration().step, window_length));
  if (structure->declaration().free_velocity) return true;
  throw core::ConfigError(
      fmt::format("particles.implicit_contact needs a structure that says how it would move without contact; "
                  "{} does not",
                  structure->declaration().program));
}

/// Particles look at the window's end where they take several steps, and where the structure wants forces of
/// times beyond the middle of their only step.
bool needs_boundary_end(const Declaration& particles, const Declaration& structure,
                        const WindowLengths& windows) {
  const double half = 0.5 * windows.regular, shift = structure.force_shift(windows.regular);
  return particles.takes_several_steps(windows.longest) || shift < half * (1 - core::whole_ratio);
}

void lay_out_arrays(Session& session, const std::optional<Interface>& interface, const WindowLengths& windows,
                    Order order) {
  const bool free_velocity = needs_free_velocity(session, windows.regular);
  const bool iterated = order == Order::iterated || order == Order::iterated_light;
  if (free_velocity && iterated)
    throw core::ConfigError(
        "particles.implicit_contact is for the explicit schemes of 'coupling'; a strong scheme iterates "
        "instead");
  const Peer* structure = session.find(Role::structure);
  const bool loses_cells = interface && structure->declaration().loses_cells;
  if (loses_cells) refuse_other_cells(*interface);
  bool needs_end = false;
  for (Peer* peer : session.peers()) {
    Session::request_array(*peer, ArrayName::outputs, peer->output_arrays().size());
    if (!interface) continue;
    const bool is_structure = peer->role() == Role::structure;
    const std::size_t values = (is_structure ? interface->structure : interface->boundary).positions.size();
    for (const auto name : {ArrayName::force, ArrayName::displacement, ArrayName::velocity}) {
      Session::request_array(*peer, name, values);
    }
    if (free_velocity) Session::request_array(*peer, ArrayName::free_velocity, values);
    if (loses_cells) Session::request_array(*peer, ArrayName::lost, interface->structure.cell_count());
    if (is_structure) continue;
    needs_end = iterated || needs_boundary_end(peer->declaration(),
                                               session.find(Role::structure)->declaration(), windows);
    if (!needs_end) continue;
    Session::request_array(*peer, ArrayName::end_displacement, values);
    Session::request_array(*peer, ArrayName::end_velocity, values);
    if (order != Order::iterated_light) continue;
    refuse_heavy_boundary(*peer);
    Session::request_array(*peer, ArrayName::moved_displacement, values);
    Session::request_array(*peer, ArrayName::moved_velocity, values);
  }
  const bool one_set =
      interface && order == Order::in_turn && !needs_end && interface->tie.mapping.is_identity();
  session.create_arrays(one_set ? ArraySets::one : ArraySets::one_each);
}

}  // namespace talus::coupler
