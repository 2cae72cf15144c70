#pragma once

#include "core/parallel.hpp"
#include "dem_solver/boundary/planes.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/rigid_contact.hpp"

namespace talus::dem {

/// Contacts of spheres with planes.
template <class Law>
class PlaneContacts : public ContactBatch<Law> {
 public:
  struct Context {
    Spheres& spheres;
    std::span<const Plane> planes;
    PlaneList& list;
    const PairTable& table;
    double step = 0;  ///< s
    int threads = 1;
  };

  /// A task is a chunk of the list.
  void rebuild(const PlaneList& list, std::span<const SlotMove> moves) {
    ContactBatch<Law>::rebuild(list.slots(), moves, list.chunk_count());
  }

  /// Each sphere's planes in their order, so that a sphere in a corner gets its forces in a fixed one.
  void evaluate(const Context& context) noexcept {
    this->clear_work();
    core::parallel_tasks({context.list.chunk_count(), context.threads},
                         [&](std::int64_t chunk) { evaluate_chunk(context, static_cast<Index>(chunk)); });
  }

 private:
  using ContactBatch<Law>::memory_;

  void evaluate_chunk(const Context& context, Index chunk) noexcept {
    ContactWork work;
    for (Index slot = context.list.chunk_first()[chunk]; slot < context.list.chunk_first()[chunk + 1];
         ++slot) {
      const auto [i, k] = context.list.entries()[slot];
      const Plane& plane = context.planes[k];
      const double radius = context.spheres.position[i].w;
      const double overlap = radius - height_above(plane, context.spheres.position[i]);
      std::uint8_t& touched = context.list.touched()[slot];
      if (overlap <= 0 && !touched) continue;
      touched = overlap > 0;
      const RigidTouch touch{.sphere = i,
                             .normal = plane.normal,
                             .overlap = overlap,
                             .reduced_radius = radius,
                             .partner_velocity = {},
                             .velocity_gain = {},
                             .parameters = &context.table(context.spheres.material[i], plane.material)};
      auto memory = memory_.recall(slot);
      evaluate_rigid_contact<Law>(context.spheres, touch, context.step, memory, work);
      memory_.remember(slot, memory);
    }
    this->add_work(chunk, work);
  }
};

}  // namespace talus::dem
