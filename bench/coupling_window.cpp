// Cost of one coupling window through the coupler process: three processes, shared memory, mapping included.
// One JSON object a line.
//
// `us_per_window` is the serial explicit scheme between two participants that only touch every interface
// value once (the particles write a force on every node, the structure reads it and writes a motion).
// `mapping` says what Ω_D is: "identical" to Ω_S, node for node, or "tied", the same net shifted so that its
// nodes hang between those of Ω_S.
// `floor_us` is what the same three processes need to wake each other in the same order with nothing to pass
// on. Both are medians over repetitions, which alternate.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

#include "coupler/schemes/serial_explicit.hpp"
#include "coupler/session/introduction.hpp"
#include "coupler/transport/segment.hpp"
#include "interface_mesh/square_net.hpp"

using namespace talus;

namespace {

constexpr double window_length = 50e-6;
constexpr int windows_a_repetition = 2000;
constexpr int repetitions = 7;

mesh::Surface net_of(int nodes) {
  const auto side = static_cast<mesh::Index>(std::lround(std::sqrt(nodes))) - 1;
  const auto other = static_cast<mesh::Index>(nodes / (side + 1)) - 1;
  return mesh::generate(mesh::SquareNet{.lengths = {1, 1}, .openings = {side, other}}).surface;
}

void serve_structure(coupler::Participant& participant, const mesh::Surface& surface) {
  participant.publish_surface(surface,
                              std::vector<double>(static_cast<std::size_t>(surface.node_count()), 1.0));
  participant.declare({.program = "bench", .limits = {}, .effects = {}, .outputs = {}});
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.structure_fields();
    if (command.action == coupler::Action::advance) {
      for (std::size_t i = 0; i < fields.force.size(); ++i) {
        fields.displacement[i] = 1e-3 * fields.force[i];
        fields.velocity[i] = 1e-2 * fields.force[i];
      }
    }
    participant.answer();
  }
}

void serve_particles(coupler::Participant& participant) {
  std::vector<double> masses;
  participant.receive_surface(masses);
  participant.declare({.program = "bench", .limits = {}, .effects = {}, .outputs = {}});
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.particle_fields();
    if (command.action == coupler::Action::advance) {
      for (std::size_t i = 0; i < fields.force.size(); ++i) {
        fields.force[i] = 1 + 1e-3 * (fields.start_displacement[i] + fields.start_velocity[i]);
      }
    }
    participant.answer();
  }
}

/// A participant in a process of its own, as the launcher would start it.
pid_t fork_participant(const std::string& segment, coupler::Role role,
                       const std::function<void(coupler::Participant&)>& serve) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  int status = 0;
  try {
    const auto participant = coupler::Participant::join({.segment = segment, .role = role});
    serve(*participant);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    status = 1;
  }
  _exit(status);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

template <class Window>
double microseconds_a_window(Window&& compute) {
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < windows_a_repetition; ++n) compute(coupler::Window{.index = n, .unit = window_length});
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() /
         windows_a_repetition;
}

coupler::InterfacePlan tied_between_nodes() {
  coupler::InterfacePlan plan = coupler::identical_surfaces();
  plan.make_boundary = [](const mesh::Surface& structure) {
    mesh::Surface boundary = structure;
    const double shift = 0.3 / std::sqrt(structure.node_count());
    for (std::size_t i = 0; i < boundary.positions.size(); i += 3) boundary.positions[i] += shift;
    return boundary;
  };
  plan.tie = [](const mesh::Surface& boundary, const mesh::Surface& structure) {
    constexpr double anywhere = 1;
    return mesh::tie_to_nearest_feature(boundary, structure, anywhere);
  };
  return plan;
}

void measure(int nodes, const char* mapping, const coupler::InterfacePlan& plan) {
  const mesh::Surface surface = net_of(nodes);
  coupler::Session session(coupler::transport::create_shared_segment(), {});
  coupler::Peer& structure = session.await(coupler::Role::structure);
  coupler::Peer& particles = session.await(coupler::Role::particles);
  const std::string name = session.segment_name();
  const pid_t first =
      fork_participant(name, coupler::Role::structure, [&](auto& p) { serve_structure(p, surface); });
  const pid_t second = fork_participant(name, coupler::Role::particles, serve_particles);
  session.wait_joined();
  const auto interface = coupler::introduce(session, plan);
  coupler::lay_out_arrays(session, interface, {window_length}, coupler::Order::in_turn);
  coupler::Exchange exchange(session, interface->tie.mapping);

  std::vector<double> full, floor;
  for (int repetition = 0; repetition <= repetitions; ++repetition) {  // the first one warms up
    full.push_back(microseconds_a_window(
        [&](const auto& window) { coupler::SerialExplicit{}.compute(exchange, window); }));
    floor.push_back(microseconds_a_window([&](const auto& window) {
      // A report without output values: the same wake-ups, no work on either side.
      session.ask(particles, {.action = coupler::Action::report, .window = window.index});
      session.ask(structure, {.action = coupler::Action::report, .window = window.index});
    }));
  }
  full.erase(full.begin());
  floor.erase(floor.begin());
  session.finish();
  for (const pid_t pid : {first, second}) waitpid(pid, nullptr, 0);
  const double window_us = median(full), floor_us = median(floor);
  fmt::print(
      "{{\"nodes\":{},\"mapping\":\"{}\",\"us_per_window\":{:.2f},\"floor_us\":{:.2f},\"ratio\":{:.2f}}}\n",
      surface.node_count(), mapping, window_us, floor_us, window_us / floor_us);
}

}  // namespace

int main() {
  for (const int nodes : {10, 1000, 10000}) measure(nodes, "identical", coupler::identical_surfaces());
  for (const int nodes : {1000, 10000}) measure(nodes, "tied", tied_between_nodes());
}
