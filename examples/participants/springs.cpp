/// A first structural solver: 25 masses on springs, with triangles between them for rocks to land on.
/// The coupler starts it as `springs_cpp scene.yaml --join SEGMENT`.
#include <algorithm>
#include <array>
#include <cmath>

#include "coupler/participant.hpp"

using namespace talus;
using coupler::Action;

constexpr int side = 5, nodes = side * side;
constexpr double mass = 10, stiffness = 2e4, spacing = 0.5;  // kg, N/m, m

struct State {
  std::array<double, 3 * nodes> displacement{}, velocity{};

  /// One step of the leapfrog: forces at its start, velocity from half a step before to half a step after.
  void advance(std::span<const double> force, double step) {
    for (std::size_t i = 0; i < force.size(); ++i) {
      velocity[i] += step * (force[i] - stiffness * displacement[i]) / mass;
      displacement[i] += step * velocity[i];
    }
  }
};

mesh::Surface square() {
  mesh::Surface surface;
  for (int n = 0; n < nodes; ++n) {
    surface.positions.insert(surface.positions.end(), {spacing * (n % side), spacing * (n / side), 0});
    if (n % side == side - 1 || n / side == side - 1) continue;
    surface.triangles.push_back({n, n + 1, n + 1 + side});
    surface.triangles.push_back({n, n + 1 + side, n + side});
  }
  surface.parts = {{.name = "square", .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  return surface;
}

int main(int argc, char** argv) {
  const auto self = coupler::Participant::join({.segment = argv[argc - 1]});
  self->publish_surface(square(), std::vector<double>(nodes, mass));
  coupler::Declaration declaration{.program = "springs.cpp", .checkpoints = true};
  declaration.limits = {
      {.name = "springs", .seconds = 2 * std::sqrt(mass / stiffness), .reason = "2 sqrt(m/k)"}};
  declaration.outputs.probes = {{.name = "middle.displacement_z_m"}};
  self->declare(declaration);
  State now, saved;
  for (auto command = self->next(); command.action != Action::finish; command = self->next()) {
    const auto fields = self->structure_fields();
    if (command.action == Action::advance) now.advance(fields.force, command.length);
    if (command.action == Action::save_state) saved = now;
    if (command.action == Action::restore_state) now = saved;
    coupler::checkpoint_state(command, std::as_writable_bytes(std::span(&now, 1)));
    if (command.action == Action::report) self->probes()[0] = now.displacement[3 * (nodes / 2) + 2];
    std::ranges::copy(now.displacement, fields.displacement.begin());
    std::ranges::copy(now.velocity, fields.velocity.begin());
    self->answer();
  }
}
