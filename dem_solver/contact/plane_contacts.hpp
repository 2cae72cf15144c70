#pragma once

#include <span>

#include "dem_solver/boundary/planes.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/four_contacts.hpp"
#include "dem_solver/contact/rigid_contact.hpp"

namespace talus::dem {

/// Contacts of spheres with planes: rigid ones, R* = R.
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
      const double overlap = p.w - height_above(context.planes[k], p);
      const bool touches = overlap > 0;
      contacts[count] = {i, k, slot, overlap};
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
    double overlap = 0;  ///< m
  };

  /// Evaluates the contacts collected so far.
  /// @return how many are left: none
  int flush(const Context& context, Touching* contacts, int count, ContactWork& work) noexcept {
    in_fours(contacts, count,
             [&](const Touching* four, int active) { evaluate_four(context, four, active, work); });
    return 0;
  }

  TALUS_INLINE void evaluate_four(const Context& context, const Touching* contacts, int active,
                                  ContactWork& work) noexcept {
    Spheres& s = context.spheres;
    const auto sphere = [&](int k) { return contacts[k].sphere; };
    const auto slot = [&](int k) { return contacts[k].slot; };
    const auto plane = [&](int k) -> const Plane& { return context.planes[contacts[k].plane]; };
    const auto of_contacts = [&](auto value) { return Lanes{value(0), value(1), value(2), value(3)}; };

    RigidMeeting<Lanes> meeting{.position = gathered(s.position, sphere),
                                .velocity = gathered(s.velocity, sphere),
                                .spin = {},
                                .normal = {of_contacts([&](int k) { return plane(k).normal.x; }),
                                           of_contacts([&](int k) { return plane(k).normal.y; }),
                                           of_contacts([&](int k) { return plane(k).normal.z; })},
                                .overlap = of_contacts([&](int k) { return contacts[k].overlap; })};
    meeting.reduced_radius = meeting.position.w;
    meeting.arm = meeting.position.w - meeting.overlap;
    if constexpr (Law::spreads_over_area)
      meeting.area = seen_area(gathered(s.facing, sphere), meeting.normal);
    if constexpr (Law::has_friction) meeting.spin = triple(gathered(s.spin, sphere));
    const auto parameters = gathered_parameters<Law>([&](int k) -> const PairParameters& {
      return context.table(s.material[sphere(k)], plane(k).material);
    });
    const ContactLoad<Lanes> load =
        this->loads_of_four(touch_of<Law>(meeting), parameters, context.step, slot, active, work);

    scatter(s.force, sphere, active, load.force, load.stiffness);
    if constexpr (Law::has_friction) scatter(s.torque, sphere, active, torque_of<Law>(meeting, load));
  }
};

}  // namespace talus::dem
