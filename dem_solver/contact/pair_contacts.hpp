#pragma once

#include <vector>

#include "dem_solver/collision/pair_list.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/four_contacts.hpp"

namespace talus::dem {

/// A pair that touches, or did at the last step and is to forget it.
struct TouchingPair {
  Index first = 0, second = 0, slot = 0;
};

/// Contacts between spheres: a cheap test picks the touching pairs, the law then works on four of them at a
/// time.
template <class Law>
class PairContacts : public ContactBatch<Law> {
 public:
  /// A task is a block; the last is that of the wide pairs.
  void rebuild(const PairList& list, std::span<const SlotMove> moves) {
    ContactBatch<Law>::rebuild(list.slots(), moves, list.block_count() + 1);
  }

  struct Context {
    Spheres& spheres;
    PairList& list;
    const PairTable& table;
    double step = 0;  ///< s
  };

  /// Adds the contact forces (and torques) of a block's pairs to their spheres, which are of this block and
  /// the two beside it.
  void evaluate_block(const Context& context, Index block) noexcept {
    const Candidates from = candidates(context);
    const Index begin = context.list.block_first()[block], end = context.list.block_first()[block + 1];
    Buffer pairs;
    int count = 0;
    ContactWork work;
    for (Index i = begin; i < end; ++i) {
      const Index last = from.first[i + 1];
      for (Index slot = from.first[i]; slot < last; ++slot) {
        pairs[count] = {i, from.other[slot], slot};
        count += is_at_work(from, pairs[count]);
        if (count == buffer_size) count = flush(context, pairs, count, work);
      }
    }
    flush(context, pairs, count, work);
    this->set_work(block, work);
  }

  /// The same of the wide pairs, whose spheres are anywhere.
  void evaluate_wide(const Context& context) noexcept {
    Buffer pairs;
    int count = 0;
    ContactWork work;
    const Candidates from = candidates(context);
    Index slot = static_cast<Index>(context.list.other().size());
    for (const PairList::WidePair& pair : context.list.wide()) {
      pairs[count] = {pair.first, pair.second, slot++};
      count += is_at_work(from, pairs[count]);
      if (count == buffer_size) count = flush(context, pairs, count, work);
    }
    flush(context, pairs, count, work);
    this->set_work(context.list.block_count(), work);
  }

 private:
  using ContactBatch<Law>::memory_;
  static constexpr int buffer_size =
      256;  ///< touching pairs collected before the law runs; stays in the first-level cache
  static constexpr int prefetched_ahead = 16;  ///< pairs; as long as memory takes to answer

  using Buffer = TouchingPair[buffer_size + lane_count];

  /// The arrays of the search for touching pairs as bare pointers: `touched` is bytes, which might overlap
  /// anything, so that every write to it would have the other addresses loaded again.
  struct Candidates {
    const Row* position;
    const Index* first;
    const Index* other;
    std::uint8_t* touched;
  };

  static Candidates candidates(const Context& context) noexcept {
    return {context.spheres.position.data(), context.list.first().data(), context.list.other().data(),
            context.list.touched().data()};
  }

  /// Whether the pair touches or did: 0 or 1 to count with, since in a dense bed neither is rare enough to
  /// branch.
  TALUS_INLINE static int is_at_work(const Candidates& from, const TouchingPair& pair) noexcept {
    const Lanes mirrored = load(from.position[pair.first]) * Lanes{-1, -1, -1, 1};
    const Lanes apart = load(from.position[pair.second]) + mirrored;  // w: the distance at which they touch
    const Lanes squared = apart * apart;
    const bool touches = squared[0] + squared[1] + squared[2] < squared[3];
    std::uint8_t& touched = from.touched[pair.slot];
    const int at_work = touches | touched;
    touched = touches;
    return at_work;
  }

  /// Evaluates the pairs collected so far.
  /// @return how many are left: none
  int flush(const Context& context, Buffer& pairs, int count, ContactWork& work) noexcept {
    in_fours(pairs, count, [&](const TouchingPair* four, int active) {
      const TouchingPair* const ahead = four + prefetched_ahead;
      if (ahead + lane_count <= pairs + count) fetch_partners(context, ahead);
      evaluate_four(context, four, active, work);
    });
    return 0;
  }

  /// Asks for what four pairs will need of their second spheres: those come in no order that the processor
  /// could foresee. Pays where the spheres are more than the caches hold.
  TALUS_INLINE void fetch_partners(const Context& context, const TouchingPair* pairs) const noexcept {
    const Spheres& s = context.spheres;
    for (int k = 0; k < lane_count; ++k) {
      const Index second = pairs[k].second;
      __builtin_prefetch(&s.velocity[second]);
      __builtin_prefetch(&s.force[second], 1);
      if constexpr (Law::has_friction) {
        __builtin_prefetch(&s.spin[second]);
        __builtin_prefetch(&s.torque[second], 1);
      }
      memory_.fetch(pairs[k].slot);
    }
  }

  TALUS_INLINE void evaluate_four(const Context& context, const TouchingPair* pairs, int active,
                                  ContactWork& work) noexcept {
    Spheres& s = context.spheres;
    const auto slot = [&](int k) { return pairs[k].slot; };
    const auto first = [&](int k) { return pairs[k].first; };
    const auto second = [&](int k) { return pairs[k].second; };
    const Quad<Lanes> pa = gathered(s.position, first), pb = gathered(s.position, second);
    const Quad<Lanes> va = gathered(s.velocity, first), vb = gathered(s.velocity, second);
    const Triple<Lanes> apart = triple(pa) - triple(pb);
    const Lanes distance = larger(square_root(dot(apart, apart)), Lanes{} + 1e-300);

    Touch<Lanes> touch;
    touch.normal = (1.0 / distance) * apart;
    touch.overlap = pa.w + pb.w - distance;
    touch.velocity = triple(va) - triple(vb);
    const Lanes radii = pa.w + pb.w, masses = va.w + vb.w, inverse = 1.0 / (radii * masses);
    touch.reduced_radius = pa.w * pb.w * masses * inverse;
    touch.reduced_mass = va.w * vb.w * radii * inverse;
    // Both arms end at the same point, so that the pair's angular momentum is kept.
    const Lanes arm_a = pa.w - 0.5 * touch.overlap, arm_b = pb.w - 0.5 * touch.overlap;
    if constexpr (Law::has_friction) {
      const Quad<Lanes> wa = gathered(s.spin, first), wb = gathered(s.spin, second);
      touch.velocity = touch.velocity - cross(arm_a * triple(wa) + arm_b * triple(wb), touch.normal);
      touch.spin = triple(wa) - triple(wb);
    }
    if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
    if constexpr (Law::has_rolling) {
      const Lanes ia = 1.4 * va.w * pa.w * pa.w,
                  ib = 1.4 * vb.w * pb.w * pb.w;  // 7/5 m R^2, about the contact point
      touch.reduced_inertia = ia * ib / (ia + ib);
    }

    if constexpr (Law::spreads_over_area) {
      const Lanes area_a = seen_area(gathered(s.facing, first), touch.normal),
                  area_b = seen_area(gathered(s.facing, second), -1.0 * touch.normal);
      touch.area = smaller(area_a, area_b);
    }

    const auto parameters = gathered_parameters<Law>([&](int k) -> const PairParameters& {
      return context.table(s.material[first(k)], s.material[second(k)]);
    });
    const ContactLoad<Lanes> load = this->loads_of_four(touch, parameters, context.step, slot, active, work);

    scatter(s.force, first, active, load.force, load.stiffness);
    scatter(s.force, second, active, -1.0 * load.force, load.stiffness);
    if constexpr (Law::has_friction) {
      const Triple<Lanes> turn = cross(load.force, touch.normal);
      Triple<Lanes> on_a = arm_a * turn, on_b = arm_b * turn;
      if constexpr (Law::has_rolling) {
        on_a = on_a + load.rolling_torque;
        on_b = on_b - load.rolling_torque;
      }
      scatter(s.torque, first, active, on_a);
      scatter(s.torque, second, active, on_b);
    }
  }
};

}  // namespace talus::dem
