#pragma once

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

  void rebuild(const PlaneList& list, std::span<const SlotMove> moves) {
    ContactBatch<Law>::rebuild(list.slots(), moves, list.slots() / chunk + 1);
  }

  /// Plane after plane, so that a sphere in a corner gets its forces in a fixed order; the spheres of one
  /// plane in any.
  void evaluate(const Context& context) noexcept {
    this->clear_work();
    const auto first = context.list.first();
    for (std::size_t k = 0; k + 1 < first.size(); ++k) {
      const Index begin = first[k] / chunk, end = (first[k + 1] + chunk - 1) / chunk;
#pragma omp parallel for schedule(static) num_threads(context.threads) if (context.threads > 1)
      for (Index c = begin; c < end; ++c)
        evaluate_range(context, std::max(first[k], c * chunk), std::min(first[k + 1], (c + 1) * chunk), c);
    }
  }

 private:
  using ContactBatch<Law>::memory_;
  static constexpr Index chunk = 512;  ///< entries a task; fixed, so that sums don't depend on the threads

  void evaluate_range(const Context& context, Index begin, Index end, Index task) noexcept {
    ContactWork work;
    for (Index slot = begin; slot < end; ++slot) {
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
    this->add_work(task, work);
  }
};

}  // namespace talus::dem
