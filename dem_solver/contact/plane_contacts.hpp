#pragma once

#include "dem_solver/boundary/planes.hpp"
#include "dem_solver/contact/memory.hpp"
#include "dem_solver/contact/rigid_contact.hpp"

namespace talus::dem {

/// Contacts of spheres with planes.
template <class Law>
class PlaneContacts {
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
    memory_.rebuild(list.slots(), moves);
    if constexpr (Law::has_ledger) chunk_loss_.assign(static_cast<std::size_t>(list.slots() / chunk) + 1, {});
  }

  /// Plane after plane, so that a sphere in a corner gets its forces in a fixed order; the spheres of one
  /// plane in any.
  void evaluate(const Context& context) noexcept {
    if constexpr (Law::has_ledger) chunk_loss_.assign(chunk_loss_.size(), {});
    const auto first = context.list.first();
    for (std::size_t k = 0; k + 1 < first.size(); ++k) {
      const Index begin = first[k] / chunk, end = (first[k + 1] + chunk - 1) / chunk;
#pragma omp parallel for schedule(static) num_threads(context.threads) if (context.threads > 1)
      for (Index c = begin; c < end; ++c)
        evaluate_range(context, std::max(first[k], c * chunk), std::min(first[k + 1], (c + 1) * chunk), c);
    }
  }

  ContactWork last_work() const noexcept requires Law::has_ledger {
    ContactWork work;
    for (const ContactWork& loss : chunk_loss_) work += loss;
    return work;
  }
  double stored_energy() const noexcept requires Law::has_ledger {
    double sum = 0;
    for (const auto& memory : memory_.all()) sum += Law::stored_energy(memory);
    return sum;
  }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    ContactMemory<Law>::visit_state(self.memory_, visit);
  }

 private:
  static constexpr Index chunk = 512;  ///< entries a task; fixed, so that sums don't depend on the threads

  void evaluate_range(const Context& context, Index begin, Index end, Index task) noexcept {
    ContactWork work;
    typename Law::StoredMemory none{};
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
                             .parameters = &context.table(context.spheres.material[i], plane.material)};
      if constexpr (Law::memory_rows > 0)
        evaluate_rigid_contact<Law>(context.spheres, touch, context.step, memory_[slot], work);
      else
        evaluate_rigid_contact<Law>(context.spheres, touch, context.step, none, work);
    }
    if constexpr (Law::has_ledger) chunk_loss_[task] += work;
  }

  [[no_unique_address]] ContactMemory<Law> memory_;
  std::vector<ContactWork> chunk_loss_;  ///< a chunk of entries each; empty without a ledger
};

}  // namespace talus::dem
