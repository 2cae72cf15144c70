#include "dem_solver/contact/implicit_velocities.hpp"

namespace talus::dem {
namespace {

using Contact = ImplicitVelocities::Contact;
using Bodies = ImplicitVelocities::Bodies;

void push(const Contact& contact, const Triple<double>& force, double step, Bodies& bodies) noexcept {
  Row& v = bodies.velocity[contact.sphere];
  add(v, (step * v.w) * force);
  if (contact.arm > 0) {
    Row& spin = bodies.spin[contact.sphere];
    add(spin, (step * spin.w * contact.arm) * cross(force, contact.normal));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (contact.nodes[k] < 0) continue;
    Row& node = bodies.node_velocity[contact.nodes[k]];
    add(node, (-step * contact.weights[k] * node.w) * force);
  }
}

struct InverseMasses {
  double normal = 0, tangential = 0;  ///< 1/kg
};

InverseMasses inverse_masses(const Contact& contact, const Bodies& bodies) noexcept {
  double sum = bodies.velocity[contact.sphere].w;
  for (std::size_t k = 0; k < 3; ++k) {
    if (contact.nodes[k] < 0) continue;
    sum += contact.weights[k] * contact.weights[k] * bodies.node_velocity[contact.nodes[k]].w;
  }
  const double turning = contact.arm > 0 ? contact.arm * contact.arm * bodies.spin[contact.sphere].w : 0;
  return {sum, sum + turning};
}

struct Answer {
  Triple<double> force;
  double amplification = 0;  ///< of a change of force by the next step's dashpot, 1 + c dt g
};

/// The force this contact answers with, all others as they are.
Answer answer(const Contact& contact, const Bodies& bodies, double step) noexcept {
  const InverseMasses g = inverse_masses(contact, bodies);
  const Triple<double> u = ImplicitVelocities::relative_velocity(contact, bodies);
  const Triple<double>& n = contact.normal;
  const double old_normal = dot(contact.force, n), un = dot(u, n);
  const Triple<double> old_tangential = contact.force - old_normal * n;

  const double un_free = un - step * g.normal * old_normal;
  const double amplification = 1 + contact.damping * step * g.normal;
  const double normal = std::max(0.0, (contact.elastic - contact.damping * un_free) / amplification);
  const double drag = contact.tangential_stiffness * step + contact.tangential_damping;
  if (drag <= 0) return {normal * n, amplification};
  const Triple<double> ut_free = (u - un * n) - (step * g.tangential) * old_tangential;
  Triple<double> tangential = (1 / (1 + drag * step * g.tangential)) * (contact.spring - drag * ut_free);
  const double size = length(tangential), limit = contact.coefficient * normal;
  if (size > limit) tangential = (limit / size) * tangential;
  return {normal * n + tangential, amplification};
}

}  // namespace

Triple<double> ImplicitVelocities::relative_velocity(const Contact& contact, const Bodies& bodies) noexcept {
  Triple<double> u = triple<double>(bodies.velocity[contact.sphere]);
  if (contact.arm > 0)
    u = u - contact.arm * cross(triple<double>(bodies.spin[contact.sphere]), contact.normal);
  for (std::size_t k = 0; k < 3; ++k)
    if (contact.nodes[k] >= 0)
      u = u - contact.weights[k] * triple<double>(bodies.node_velocity[contact.nodes[k]]);
  return u;
}

int ImplicitVelocities::solve(std::span<Contact> contacts, Bodies& bodies, double step,
                              const Control& control) noexcept {
  for (const Contact& contact : contacts) push(contact, contact.force, step, bodies);
  for (int sweep = 1; sweep <= control.most_sweeps; ++sweep) {
    double largest_change = 0, largest_force = 0;
    for (Contact& contact : contacts) {
      const auto [force, amplification] = answer(contact, bodies, step);
      const Triple<double> change = force - contact.force;
      push(contact, change, step, bodies);
      contact.force = force;
      largest_change = std::max(largest_change, amplification * amplification * dot(change, change));
      largest_force = std::max(largest_force, dot(force, force));
    }
    if (largest_change <= control.tolerance * control.tolerance * largest_force) return sweep;
  }
  return control.most_sweeps + 1;
}

}  // namespace talus::dem
