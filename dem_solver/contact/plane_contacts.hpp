#pragma once

#include <span>

#include "dem_solver/boundary/planes.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/four_contacts.hpp"

namespace talus::dem {

/// Contacts of spheres with planes. A plane is rigid in the law: m* = m, R* = R, and the contact point lies on
/// it.
template <class Law>
class PlaneContacts : public ContactBatch<Law> {
 public:
  struct Context {
    Spheres& spheres;
    std::span<const Plane> planes;
    PlaneList& list;
    const PairTable& table;
    double step = 0;  ///< s
  };

  /// A task is a block.
  void rebuild(const PlaneList& list, std::span<const SlotMove> moves) {
    ContactBatch<Law>::rebuild(list.slots(), moves, list.block_count());
  }

  /// Each sphere's planes in their order, so that a sphere in a corner gets its forces in a fixed one.
  void evaluate_block(const Context& context, Index block) noexcept {
    Touching contacts[buffer_size + lane_count];
    int count = 0;
    ContactWork work;
    const auto entries = context.list.entries();
    const auto touched = context.list.touched();
    const auto first = context.list.block_first();
    for (Index slot = first[block]; slot < first[block + 1]; ++slot) {
      const auto [i, k] = entries[slot];
      const Row& p = context.spheres.position[i];
      const bool touches = height_above(context.planes[k], p) < p.w;
      contacts[count] = {i, k, slot};
      count += touches | touched[slot];
      touched[slot] = touches;
      if (count == buffer_size) count = flush(context, contacts, count, work);
    }
    flush(context, contacts, count, work);
    this->set_work(block, work);
  }

 private:
  using ContactBatch<Law>::memory_;
  static constexpr int buffer_size = 64;

  /// A sphere that touches a plane, or did at the last step and is to forget it.
  struct Touching {
    Index sphere = 0, plane = 0, slot = 0;
  };

  /// Evaluates the contacts collected so far.
  /// @return how many are left: none
  int flush(const Context& context, Touching* contacts, int count, ContactWork& work) noexcept {
    fill_up(contacts, count);
    for (int k = 0; k < count; k += lane_count)
      evaluate_four(context, contacts + k, std::min(count - k, lane_count), work);
    return 0;
  }

  TALUS_INLINE void evaluate_four(const Context& context, const Touching* contacts, int active,
                                  ContactWork& work) noexcept {
    Spheres& s = context.spheres;
    const auto sphere = [&](int k) { return contacts[k].sphere; };
    const auto slot = [&](int k) { return contacts[k].slot; };
    const auto plane = [&](int k) -> const Plane& { return context.planes[contacts[k].plane]; };
    const auto of_planes = [&](auto value) { return Lanes{value(0), value(1), value(2), value(3)}; };

    const Quad<Lanes> p = gathered(s.position, sphere), v = gathered(s.velocity, sphere);
    Touch<Lanes> touch;
    touch.normal = {of_planes([&](int k) { return plane(k).normal.x; }),
                    of_planes([&](int k) { return plane(k).normal.y; }),
                    of_planes([&](int k) { return plane(k).normal.z; })};
    touch.overlap = p.w - of_planes([&](int k) { return height_above(plane(k), s.position[sphere(k)]); });
    touch.velocity = triple(v);
    touch.reduced_radius = p.w;
    touch.reduced_mass = v.w;
    const Lanes arm = p.w - touch.overlap;
    if constexpr (Law::has_friction) {
      touch.spin = triple(gathered(s.spin, sphere));
      touch.velocity = touch.velocity - arm * cross(touch.spin, touch.normal);
    }
    if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
    if constexpr (Law::has_rolling) touch.reduced_inertia = 1.4 * v.w * p.w * p.w;  // about the contact point

    const auto parameters = gathered_parameters<Law>([&](int k) -> const PairParameters& {
      return context.table(s.material[sphere(k)], plane(k).material);
    });
    auto memory = memory_.lanes(slot);
    ContactLoss<Lanes> loss;
    const ContactLoad<Lanes> load = Law::evaluate(touch, parameters, context.step, memory, loss);
    memory_.store_lanes(slot, active, memory);

    scatter(s.force, sphere, active, load.force);
    if constexpr (Law::has_friction) {
      Triple<Lanes> torque = arm * cross(load.force, touch.normal);
      if constexpr (Law::has_rolling) torque = torque + load.rolling_torque;
      scatter(s.torque, sphere, active, torque);
    }
    if constexpr (Law::has_ledger)
      for (int k = 0; k < active; ++k) work += {.damping = loss.damping[k], .friction = loss.friction[k]};
  }
};

}  // namespace talus::dem
