#pragma once

#include <vector>

#include "core/parallel.hpp"
#include "dem_solver/collision/pair_list.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/law.hpp"
#include "dem_solver/contact/materials.hpp"

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
    int threads = 1;
  };

  /// Adds the contact forces (and torques) of all pairs to the spheres, in an order that does not depend on
  /// the number of threads.
  void evaluate(const Context& context) noexcept {
    this->clear_work();
    for (Index pass = 0; pass < PairList::passes; ++pass) {
      const Index blocks = (context.list.block_count() + 1 - pass) / PairList::passes;
      core::parallel_tasks({blocks, context.threads}, [&](std::int64_t k) {
        evaluate_block(context, pass + PairList::passes * static_cast<Index>(k));
      });
    }
    if (!context.list.wide().empty()) evaluate_wide(context);
  }

 private:
  using ContactBatch<Law>::memory_;
  static constexpr int buffer_size =
      256;  ///< touching pairs collected before the law runs; stays in the first-level cache

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
    this->add_work(block, work);
  }

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
    this->add_work(context.list.block_count(), work);
  }

  /// Evaluates the pairs collected so far.
  /// @return how many are left: none
  int flush(const Context& context, Buffer& pairs, int count, ContactWork& work) noexcept {
    // The last group is filled up with its own last pair, whose results are not stored.
    for (int k = 0; k < lane_count; ++k) pairs[count + k] = pairs[count > 0 ? count - 1 : 0];
    for (int k = 0; k < count; k += lane_count)
      evaluate_four(context, pairs + k, std::min(count - k, lane_count), work);
    return 0;
  }

  TALUS_INLINE void evaluate_four(const Context& context, const TouchingPair* pairs, int active,
                                  ContactWork& work) noexcept {
    Spheres& s = context.spheres;
    const auto rows_of = [&](const std::vector<Row>& rows, Index TouchingPair::*end) {
      return transposed(load(rows[pairs[0].*end]), load(rows[pairs[1].*end]), load(rows[pairs[2].*end]),
                        load(rows[pairs[3].*end]));
    };
    const Quad<Lanes> pa = rows_of(s.position, &TouchingPair::first),
                      pb = rows_of(s.position, &TouchingPair::second);
    const Quad<Lanes> va = rows_of(s.velocity, &TouchingPair::first),
                      vb = rows_of(s.velocity, &TouchingPair::second);
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
      const Quad<Lanes> wa = rows_of(s.spin, &TouchingPair::first),
                        wb = rows_of(s.spin, &TouchingPair::second);
      touch.velocity = touch.velocity - cross(arm_a * triple(wa) + arm_b * triple(wb), touch.normal);
      touch.spin = triple(wa) - triple(wb);
    }
    if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
    if constexpr (Law::has_rolling) {
      const Lanes ia = 1.4 * va.w * pa.w * pa.w,
                  ib = 1.4 * vb.w * pb.w * pb.w;  // 7/5 m R^2, about the contact point
      touch.reduced_inertia = ia * ib / (ia + ib);
    }

    const auto slot = [&](int k) { return pairs[k].slot; };
    auto memory = memory_.lanes(slot);
    ContactLoss<Lanes> loss;
    const ContactLoad<Lanes> load =
        Law::evaluate(touch, parameters(context, pairs), context.step, memory, loss);
    memory_.store_lanes(slot, active, memory);

    scatter(s.force, pairs, active, load.force, -1.0 * load.force);
    if constexpr (Law::has_friction) {
      const Triple<Lanes> turn = cross(load.force, touch.normal);
      Triple<Lanes> on_a = arm_a * turn, on_b = arm_b * turn;
      if constexpr (Law::has_rolling) {
        on_a = on_a + load.rolling_torque;
        on_b = on_b - load.rolling_torque;
      }
      scatter(s.torque, pairs, active, on_a, on_b);
    }
    if constexpr (Law::has_ledger)
      for (int k = 0; k < active; ++k) work += {.damping = loss.damping[k], .friction = loss.friction[k]};
  }

  TALUS_INLINE static ContactParameters<Lanes> parameters(const Context& context,
                                                          const TouchingPair* pairs) noexcept {
    const auto of = [&](int k) -> const PairParameters& {
      return context.table(context.spheres.material[pairs[k].first],
                           context.spheres.material[pairs[k].second]);
    };
    const PairParameters &a = of(0), &b = of(1), &c = of(2), &d = of(3);
    const bool are_one = &a == &b && &a == &c && &a == &d;  // nearly always
    const auto lanes = [&](Row PairParameters::*part) {
      if (!are_one) return transposed(load(a.*part), load(b.*part), load(c.*part), load(d.*part));
      const Row& same = a.*part;
      return Quad<Lanes>{Lanes{} + same.x, Lanes{} + same.y, Lanes{} + same.z, Lanes{} + same.w};
    };
    ContactParameters<Lanes> p;
    p.normal = lanes(&PairParameters::normal);
    if constexpr (Law::has_friction) p.friction = lanes(&PairParameters::friction);
    if constexpr (Law::has_rolling) p.rolling = lanes(&PairParameters::rolling);
    return p;
  }

  TALUS_INLINE static void scatter(std::vector<Row>& rows, const TouchingPair* pairs, int active,
                                   const Triple<Lanes>& on_first, const Triple<Lanes>& on_second) noexcept {
    const Quad<Lanes> a = transposed(on_first.x, on_first.y, on_first.z, Lanes{});
    const Quad<Lanes> b = transposed(on_second.x, on_second.y, on_second.z, Lanes{});
    const Lanes first[] = {a.x, a.y, a.z, a.w}, second[] = {b.x, b.y, b.z, b.w};
    for (int k = 0; k < active; ++k) {
      Row& to_first = rows[pairs[k].first];
      store(to_first, load(to_first) + first[k]);
      Row& to_second = rows[pairs[k].second];
      store(to_second, load(to_second) + second[k]);
    }
  }
};

}  // namespace talus::dem
