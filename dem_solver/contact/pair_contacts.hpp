#pragma once

#include <vector>

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
  /// A task is a slab; the last is that of the wide pairs.
  void rebuild(const PairList& list, std::span<const SlotMove> moves) {
    ContactBatch<Law>::rebuild(list.slots(), moves, list.slab_count() + 1);
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
    for (int pass = 0; pass < PairList::passes; ++pass) {
      const Index slabs = context.list.slab_count();
#pragma omp parallel for schedule(dynamic) num_threads(context.threads) if (context.threads > 1)
      for (Index slab = pass; slab < slabs; slab += PairList::passes) evaluate_slab(context, slab);
    }
    if (!context.list.wide().empty()) evaluate_wide(context);
  }

 private:
  using ContactBatch<Law>::memory_;
  static constexpr int buffer_size =
      256;  ///< touching pairs collected before the law runs; stays in the first-level cache

  struct Buffer {
    TouchingPair pairs[buffer_size + lane_count];
    int count = 0;
  };

  /// Adds the pair where it touches or did; no branch, since in a dense bed neither outcome is rare.
  TALUS_INLINE static void collect(const Context& context, Buffer& buffer, TouchingPair pair) noexcept {
    const Row& p = context.spheres.position[pair.first];
    const Row& q = context.spheres.position[pair.second];
    const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z, reach = p.w + q.w;
    const bool touches = dx * dx + dy * dy + dz * dz < reach * reach;
    std::uint8_t& touched = context.list.touched()[pair.slot];
    buffer.pairs[buffer.count] = pair;
    buffer.count += touches | touched;
    touched = touches;
  }

  void evaluate_slab(const Context& context, Index slab) noexcept {
    const auto first = context.list.first();
    const auto other = context.list.other();
    const Index begin = context.list.slab_first()[slab], end = context.list.slab_first()[slab + 1];
    Buffer buffer;
    ContactWork work;
    for (Index i = begin; i < end; ++i) {
      for (Index slot = first[i]; slot < first[i + 1]; ++slot) {
        collect(context, buffer, {i, other[slot], slot});
        if (buffer.count == buffer_size) flush(context, buffer, work);
      }
    }
    flush(context, buffer, work);
    this->add_work(slab, work);
  }

  void evaluate_wide(const Context& context) noexcept {
    Buffer buffer;
    ContactWork work;
    Index slot = static_cast<Index>(context.list.other().size());
    for (const PairList::WidePair& pair : context.list.wide()) {
      collect(context, buffer, {pair.first, pair.second, slot++});
      if (buffer.count == buffer_size) flush(context, buffer, work);
    }
    flush(context, buffer, work);
    this->add_work(context.list.slab_count(), work);
  }

  void flush(const Context& context, Buffer& buffer, ContactWork& work) noexcept {
    // The last group is filled up with its own first pair, whose results are not stored.
    for (int k = 0; k < lane_count; ++k)
      buffer.pairs[buffer.count + k] = buffer.pairs[buffer.count > 0 ? buffer.count - 1 : 0];
    for (int k = 0; k < buffer.count; k += lane_count)
      evaluate_four(context, buffer.pairs + k, buffer.count - k < lane_count ? buffer.count - k : lane_count,
                    work);
    buffer.count = 0;
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
    touch.reduced_radius = pa.w * pb.w / (pa.w + pb.w);
    touch.reduced_mass = va.w * vb.w / (va.w + vb.w);
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
    const auto lanes = [&](Row PairParameters::*part) {
      return transposed(load(a.*part), load(b.*part), load(c.*part), load(d.*part));
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
