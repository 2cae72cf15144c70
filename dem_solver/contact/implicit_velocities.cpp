#include "dem_solver/contact/implicit_velocities.hpp"

namespace talus::dem {
namespace {

using Contact = ImplicitVelocities::Contact;
using Bodies = ImplicitVelocities::Bodies;

/// Where a force acts on the body and on nodes of the boundary.
struct Place {
  const Triple<double>& lever;
  const std::array<Index, 3>& nodes;
  const std::array<double, 3>& weights;
};
Place at_contact(const Contact& contact) noexcept {
  return {contact.lever, contact.nodes, contact.weights};
}
Place at_saddle(const Contact& contact) noexcept {
  return {contact.saddle_lever, contact.saddle_nodes, contact.saddle_weights};
}

void push_at(const Place& at, Index body, const Triple<double>& force, double step, Bodies& bodies) noexcept {
  Row& v = bodies.velocity[body];
  add(v, (step * v.w) * force);
  Triple<double>& spin = bodies.spin[body];
  spin = spin + bodies.inverse_inertia[body] * (step * cross(at.lever, force));
  for (std::size_t k = 0; k < 3; ++k) {
    if (at.nodes[k] < 0) continue;
    Row& node = bodies.node_velocity[at.nodes[k]];
    add(node, (-step * at.weights[k] * node.w) * force);
  }
}

bool has_saddle(const Contact& contact) noexcept {
  return contact.saddle_nodes[0] >= 0;
}

void push(const Contact& contact, const Triple<double>& force, double step, Bodies& bodies) noexcept {
  push_at(at_contact(contact), contact.body, force, step, bodies);
  if (has_saddle(contact))
    push_at(at_saddle(contact), contact.body, -dot(force, contact.normal) * contact.saddle_normal, step,
            bodies);
}

Triple<double> velocity_at(const Place& at, Index body, const Bodies& bodies) noexcept {
  Triple<double> u = triple<double>(bodies.velocity[body]) + cross(bodies.spin[body], at.lever);
  for (std::size_t k = 0; k < 3; ++k)
    if (at.nodes[k] >= 0) u = u - at.weights[k] * triple<double>(bodies.node_velocity[at.nodes[k]]);
  return u;
}

/// 1/kg; the velocity along the normal that a unit of impulse along it makes, saddle included: |J|^2 in the inverse masses.
double normal_response_with_saddle(const Contact& contact, const Bodies& bodies) noexcept {
  const Triple<double> n = contact.normal, s = contact.saddle_normal;
  const Triple<double> along = n - s, turn = cross(contact.lever, n) - cross(contact.saddle_lever, s);
  double sum = bodies.velocity[contact.body].w * dot(along, along) +
               dot(turn, bodies.inverse_inertia[contact.body] * turn);
  for (std::size_t k = 0; k < 3; ++k) {
    if (contact.nodes[k] < 0) continue;
    Triple<double> moved = contact.weights[k] * n;
    for (std::size_t j = 0; j < 3; ++j)
      if (contact.saddle_nodes[j] == contact.nodes[k]) moved = moved - contact.saddle_weights[j] * s;
    sum += bodies.node_velocity[contact.nodes[k]].w * dot(moved, moved);
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const Index node = contact.saddle_nodes[j];
    if (node < 0 || std::ranges::find(contact.nodes, node) != contact.nodes.end()) continue;
    sum += bodies.node_velocity[node].w * contact.saddle_weights[j] * contact.saddle_weights[j];
  }
  return sum;
}

/// Some unit vector across a unit vector.
Triple<double> across(const Triple<double>& n) noexcept {
  const Triple<double> other = std::abs(n.x) < 0.6 ? Triple<double>{1, 0, 0} : Triple<double>{0, 1, 0};
  const Triple<double> t = cross(n, other);
  return (1 / length(t)) * t;
}

struct Response {
  double normal = 0, tangential = 0;  ///< 1/kg
};

Response response(const Contact& contact, const Bodies& bodies) noexcept {
  double sum = bodies.velocity[contact.body].w;
  for (std::size_t k = 0; k < 3; ++k) {
    if (contact.nodes[k] < 0) continue;
    sum += contact.weights[k] * contact.weights[k] * bodies.node_velocity[contact.nodes[k]].w;
  }
  const auto turning = [&](const Triple<double>& a, const Triple<double>& b) {
    return dot(cross(contact.lever, a), bodies.inverse_inertia[contact.body] * cross(contact.lever, b));
  };
  const Triple<double>& n = contact.normal;
  const Triple<double> s = across(n), t = cross(n, s);
  // The larger eigenvalue of the two directions along the surface.
  const double ss = turning(s, s), tt = turning(t, t), st = turning(s, t), half = 0.5 * (ss - tt);
  const double normal =
      has_saddle(contact) ? normal_response_with_saddle(contact, bodies) : sum + turning(n, n);
  return {normal, sum + 0.5 * (ss + tt) + std::sqrt(half * half + st * st)};
}

/// The normal force this contact answers with, all other forces as they are.
double normal_answer(const Contact& contact, const Response& g, const Bodies& bodies, double step) noexcept {
  const Triple<double>& n = contact.normal;
  const double un_free = dot(ImplicitVelocities::relative_velocity(contact, bodies), n) -
                         step * g.normal * dot(contact.force, n);
  return std::max(0.0,
                  (contact.elastic - contact.damping * un_free) / (1 + contact.damping * step * g.normal));
}

/// The tangential force, for the normal force that the contact has.
Triple<double> tangential_answer(const Contact& contact, const Response& g, const Bodies& bodies,
                                 double step) noexcept {
  const double drag = contact.tangential_stiffness * step + contact.tangential_damping;
  if (drag <= 0) return {};
  const Triple<double>& n = contact.normal;
  const Triple<double> u = ImplicitVelocities::relative_velocity(contact, bodies);
  const double normal = dot(contact.force, n);
  const Triple<double> old = contact.force - normal * n;
  const Triple<double> free = (u - dot(u, n) * n) - (step * g.tangential) * old;
  const Triple<double> wanted = (1 / (1 + drag * step * g.tangential)) * (contact.spring - drag * free);
  const double size = length(wanted), limit = contact.coefficient * normal;
  return size > limit ? (limit / size) * wanted : wanted;
}

/// Gives the contact the force it answers with. @return the change, N
Triple<double> relax(Contact& contact, const Response& g, double step, Bodies& bodies) noexcept {
  const Triple<double>& n = contact.normal;
  const double old_normal = dot(contact.force, n);
  const Triple<double> old_tangential = contact.force - old_normal * n;
  const Triple<double> pressed = (normal_answer(contact, g, bodies, step) - old_normal) * n;
  contact.force = contact.force + pressed;
  push(contact, pressed, step, bodies);
  const Triple<double> rubbed = tangential_answer(contact, g, bodies, step) - old_tangential;
  contact.force = contact.force + rubbed;
  push(contact, rubbed, step, bodies);
  return pressed + rubbed;
}

}  // namespace

Triple<double> ImplicitVelocities::relative_velocity(const Contact& contact, const Bodies& bodies) noexcept {
  const Triple<double> u = velocity_at(at_contact(contact), contact.body, bodies);
  if (!has_saddle(contact)) return u;
  const double there = dot(velocity_at(at_saddle(contact), contact.body, bodies), contact.saddle_normal);
  return u - there * contact.normal;
}

int ImplicitVelocities::solve(std::span<Contact> contacts, Bodies& bodies, double step,
                              const Control& control) noexcept {
  for (const Contact& contact : contacts) push(contact, contact.force, step, bodies);
  for (int sweep = 1; sweep <= control.most_sweeps; ++sweep) {
    double largest_change = 0, largest_force = 0;
    for (Contact& contact : contacts) {
      const Response g = response(contact, bodies);
      const Triple<double> change = relax(contact, g, step, bodies);
      const double amplification = 1 + contact.damping * step * g.normal;  // see Control::tolerance
      largest_change = std::max(largest_change, amplification * amplification * dot(change, change));
      largest_force = std::max(largest_force, dot(contact.force, contact.force));
    }
    if (largest_change <= control.tolerance * control.tolerance * largest_force) return sweep;
  }
  return control.most_sweeps + 1;
}

}  // namespace talus::dem
