#pragma once

#include <array>
#include <vector>

#include "dem_solver/boundary/touching_features.hpp"
#include "dem_solver/contact/memory.hpp"
#include "dem_solver/contact/rigid_contact.hpp"

namespace talus::dem {

/// Contacts of spheres with the features of a boundary, and the boundary's reactions.
template <class Law>
class BoundaryContacts {
 public:
  struct Context {
    Spheres& spheres;
    Boundary& boundary;
    BoundaryList& list;
    const PairTable& table;
    double step = 0;  ///< s
    int threads = 1;
  };

  void rebuild(const BoundaryList& list, std::span<const SlotMove> moves) {
    memory_.rebuild(list.slots(), moves);
    scratch_.resize(static_cast<std::size_t>(list.spheres().size() / chunk + 1));
    for (Scratch& s : scratch_) s.reserve(list.most_candidates());
  }

  void evaluate(const Context& context) noexcept {
    const auto count = static_cast<Index>(context.list.spheres().size());
    const Index tasks = (count + chunk - 1) / chunk;
#pragma omp parallel for schedule(dynamic) num_threads(context.threads) if (context.threads > 1 && tasks > 1)
    for (Index task = 0; task < tasks; ++task) {
      scratch_[task].work = {};
      for (Index k = task * chunk; k < std::min(count, (task + 1) * chunk); ++k)
        evaluate_sphere(context, k, scratch_[task]);
    }
    collect_reactions(context);
  }

  ContactWork last_work() const noexcept requires Law::has_ledger {
    ContactWork work;
    for (const Scratch& s : scratch_) work += s.work;
    return work;
  }
  double stored_energy(const BoundaryList& list) const noexcept requires Law::has_ledger {
    double sum = 0;
    for (std::size_t k = 0; k < list.spheres().size(); ++k)
      for (Index c = 0; c < list.count()[k]; ++c)
        sum += Law::stored_energy(memory_.all()[list.first()[k] + c]);
    return sum;
  }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    ContactMemory<Law>::visit_state(self.memory_, visit);
  }

 private:
  static constexpr Index chunk = 64;  ///< spheres a task; fixed, so that sums don't depend on the threads
  static constexpr double same_contact =
      0.866;  ///< cos 30 degrees: the most a contact's normal turns in a step

  using Memory = typename Law::StoredMemory;
  struct OldContact {
    BoundaryContact contact;
    Memory memory;
    bool continued = false;
  };
  struct Scratch {
    std::vector<FeatureTouch> touches;
    std::vector<OldContact> old;
    ContactWork work;
    void reserve(Index candidates) {
      touches.reserve(static_cast<std::size_t>(candidates));
      old.reserve(static_cast<std::size_t>(candidates));
    }
  };

  void evaluate_sphere(const Context& context, Index k, Scratch& scratch) noexcept {
    const Index begin = context.list.first()[k], end = context.list.first()[k + 1],
                i = context.list.spheres()[k];
    Index& count = context.list.count()[k];
    scratch.old.clear();
    for (Index slot = begin; slot < begin + count; ++slot)
      scratch.old.push_back({context.list.contacts()[slot], recall(slot)});

    find_touching_features(context.boundary, context.spheres.position[i],
                           context.list.candidates().subspan(begin, static_cast<std::size_t>(end - begin)),
                           scratch.touches);
    Index slot = begin;
    for (const FeatureTouch& touch : scratch.touches) {
      const Index part = context.boundary.features()[touch.feature].part;
      OldContact contact = continued(scratch.old, touch.normal, part);
      evaluate_contact(context, i, touch, contact, scratch.work);
      context.list.contacts()[slot] = contact.contact;
      remember(slot++, contact.memory);
    }
    count = slot - begin;
    if constexpr (Law::has_ledger)
      for (OldContact& ended : scratch.old)
        if (!ended.continued) end_contact(context, i, ended, scratch.work);
  }

  /// The sphere's contact of the last step that this one continues: the same part's, with the nearest normal;
  /// empty where there is none.
  static OldContact continued(std::vector<OldContact>& old, const Triple<double>& normal,
                              Index part) noexcept {
    OldContact* best = nullptr;
    double best_cosine = same_contact;
    for (OldContact& candidate : old) {
      const double cosine = dot(triple<double>(candidate.contact.normal), normal);
      if (candidate.continued || candidate.contact.part != part || cosine <= best_cosine) continue;
      best = &candidate;
      best_cosine = cosine;
    }
    if (best == nullptr) return {};
    best->continued = true;
    return *best;
  }

  void evaluate_contact(const Context& context, Index i, const FeatureTouch& touch, OldContact& contact,
                        ContactWork& work) noexcept {
    const Feature& feature = context.boundary.features()[touch.feature];
    const double radius = context.spheres.position[i].w, wire = feature.wire_radius;
    const Triple<double> velocity = context.boundary.velocity_at(feature, touch.weights);
    const RigidTouch rigid{
        .sphere = i,
        .normal = touch.normal,
        .overlap = radius - touch.distance,
        // A thin wire presses deeper than a flat face: R* of crossed cylinders, sqrt(R R r/(R + r)).
        .reduced_radius = wire > 0 ? std::sqrt(radius * radius * wire / (radius + wire)) : radius,
        .partner_velocity = velocity,
        .parameters = &context.table(context.spheres.material[i], feature.material)};
    const Triple<double> force =
        evaluate_rigid_contact<Law>(context.spheres, rigid, context.step, contact.memory, work);
    if constexpr (Law::has_ledger)
      work.boundary += 0.5 * context.step * dot(triple<double>(contact.contact.force) + force, velocity);
    contact.contact = {row(force), row(touch.normal), touch.weights, touch.feature, feature.part};
  }

  /// The last half step's work of a contact that is gone: zero force now, at the same place.
  void end_contact(const Context& context, Index i, OldContact& ended, ContactWork& work) noexcept {
    const BoundaryContact& last = ended.contact;
    FeatureTouch apart{.distance = context.spheres.position[i].w,
                       .normal = triple<double>(last.normal),
                       .weights = last.weights,
                       .feature = last.feature};
    evaluate_contact(context, i, apart, ended, work);
  }

  /// One after the other, so that a node's reactions add up in the same order for any number of threads.
  static void collect_reactions(const Context& context) noexcept {
    context.boundary.clear_reactions();
    for (std::size_t k = 0; k < context.list.spheres().size(); ++k)
      for (Index c = 0; c < context.list.count()[k]; ++c) {
        const BoundaryContact& contact = context.list.contacts()[context.list.first()[k] + c];
        context.boundary.react(context.boundary.features()[contact.feature], contact.weights,
                               triple<double>(contact.force));
      }
  }

  Memory recall(Index slot) noexcept {
    if constexpr (Law::memory_rows > 0)
      return memory_[slot];
    else
      return {};
  }
  void remember(Index slot, const Memory& memory) noexcept {
    if constexpr (Law::memory_rows > 0) memory_[slot] = memory;
  }

  [[no_unique_address]] ContactMemory<Law> memory_;
  std::vector<Scratch> scratch_;  ///< one a task
};

}  // namespace talus::dem
