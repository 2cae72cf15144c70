#pragma once

#include <array>
#include <vector>

#include "core/parallel.hpp"
#include "dem_solver/boundary/touching_features.hpp"
#include "dem_solver/contact/contact_batch.hpp"
#include "dem_solver/contact/implicit_contact.hpp"
#include "dem_solver/contact/rigid_contact.hpp"

namespace talus::dem {

/// Contacts of spheres with the features of a boundary, and the boundary's reactions.
template <class Law>
class BoundaryContacts : public ContactBatch<Law> {
 public:
  struct Context {
    Spheres& spheres;
    Boundary& boundary;
    BoundaryList& list;
    const PairTable& table;
    ContactRule rule = ContactRule::local_minima;
    double step = 0;  ///< s
    int threads = 1;
  };

  /// A task is a chunk of spheres.
  void rebuild(const BoundaryList& list, std::span<const SlotMove> moves) {
    const auto tasks = static_cast<Index>(list.spheres().size()) / chunk + 1;
    ContactBatch<Law>::rebuild(list.slots(), moves, tasks);
    scratch_.resize(static_cast<std::size_t>(tasks));
    for (Scratch& s : scratch_) s.reserve(list.most_candidates());
  }

  /// Contacts with a boundary that moves as it is told, whatever acts on it.
  void evaluate(const Context& context) noexcept {
    const auto count = static_cast<Index>(context.list.spheres().size());
    const Index tasks = (count + chunk - 1) / chunk;
    core::parallel_tasks({tasks, context.threads}, [&](std::int64_t task) {
      const auto begin = static_cast<Index>(task) * chunk;
      ContactWork work;
      for (Index k = begin; k < std::min(count, begin + chunk); ++k)
        evaluate_sphere(context, k, scratch_[task], work);
      this->set_work(static_cast<Index>(task), work);
    });
    collect_reactions(context);
  }

  /// Contacts with a boundary of nodes that the forces move within the step (ImplicitVelocities). One thread:
  /// each contact sees what those before it did.
  /// @return the sweeps that were needed; most_sweeps + 1: not converged
  int evaluate_implicitly(const Context& context, const ImplicitContact& implicit,
                          const ImplicitSystem::Scene& scene) noexcept {
    const auto spheres = static_cast<Index>(context.list.spheres().size());
    if (scratch_.empty()) return 0;
    ContactWork work;
    for (Index k = 0; k < spheres; ++k) find_contacts(context, k, scratch_[0], work);
    system_.gather_bodies(scene, context.list.spheres(), implicit, context.step);
    for_each_contact(context, [&](Index k, Index slot) { add_to_system(context, k, slot); });
    const int sweeps = system_.solve(context.step, implicit.control);
    std::size_t next = 0;
    for_each_contact(context, [&](Index k, Index slot) {
      evaluate_contact(context, k, slot, system_.velocity_gain(next++), work);
    });
    this->set_work(0, work);
    collect_reactions(context);
    return sweeps;
  }

 private:
  using ContactBatch<Law>::memory_;
  using typename ContactBatch<Law>::Memory;
  static constexpr Index chunk = 64;  ///< spheres a task; fixed, so that sums don't depend on the threads
  static constexpr double same_contact =
      0.866;  ///< cos 30 degrees: the most a contact's normal turns in a step

  struct OldContact {
    BoundaryContact contact;
    Memory memory;
    bool continued = false;
  };
  struct Scratch {
    TouchSearch search;
    std::vector<OldContact> old;
    void reserve(Index candidates) {
      search.reserve(static_cast<std::size_t>(candidates));
      old.reserve(static_cast<std::size_t>(candidates));
    }
  };

  void evaluate_sphere(const Context& context, Index k, Scratch& scratch, ContactWork& work) noexcept {
    find_contacts(context, k, scratch, work);
    const Index begin = context.list.first()[k];
    for (Index slot = begin; slot < begin + context.list.count()[k]; ++slot)
      evaluate_contact(context, k, slot, {}, work);
  }

  /// The sphere's contacts at t_n, in its slots, with the memory of those they continue.
  void find_contacts(const Context& context, Index k, Scratch& scratch, ContactWork& work) noexcept {
    const Index begin = context.list.first()[k], end = context.list.first()[k + 1],
                i = context.list.spheres()[k];
    Index& count = context.list.count()[k];
    scratch.old.clear();
    for (Index slot = begin; slot < begin + count; ++slot)
      scratch.old.push_back({context.list.contacts()[slot], memory_.recall(slot)});

    const auto touches = scratch.search.find(
        context.boundary, context.spheres.position[i],
        context.list.candidates().subspan(begin, static_cast<std::size_t>(end - begin)), context.rule);
    Index slot = begin;
    for (const FeatureTouch& touch : touches) {
      const Index part = context.boundary.features()[touch.feature].part;
      OldContact old = continued(scratch.old, touch.normal, part);
      Row normal = row(touch.normal, touch.distance);
      if (old.contact.part < 0 && !context.boundary.features()[touch.feature].is_segment()) {
        // A centre that was pressed through a face is still on the side that it came from.
        old = continued(scratch.old, -1.0 * touch.normal, part);
        if (old.contact.part >= 0) normal = row(-1.0 * touch.normal, -touch.distance);
      }
      context.list.contacts()[slot] = {.force = old.contact.force,
                                       .normal = normal,
                                       .weights = touch.weights,
                                       .feature = touch.feature,
                                       .part = part,
                                       .reach = touch.reach,
                                       .saddle = touch.saddle,
                                       .pulled = old.contact.saddle,
                                       .pull = old.contact.pull};
      memory_.remember(slot++, old.memory);
    }
    for (Index left = slot; left < begin + count; ++left) memory_.remember(left, {});
    count = slot - begin;
    if constexpr (Law::has_ledger)
      for (OldContact& ended : scratch.old)
        if (!ended.continued) end_contact(context, i, ended, work);
  }

  template <class Visit>
  static void for_each_contact(const Context& context, const Visit& visit) noexcept {
    for (std::size_t k = 0; k < context.list.spheres().size(); ++k)
      for (Index c = 0; c < context.list.count()[k]; ++c)
        visit(static_cast<Index>(k), context.list.first()[k] + c);
  }

  void add_to_system(const Context& context, Index k, Index slot) noexcept {
    const Index i = context.list.spheres()[k];
    const BoundaryContact& contact = context.list.contacts()[slot];
    const RigidTouch touch = rigid_touch(context, i, contact);
    ImplicitVelocities::Contact unknown =
        springs_at_rest<Law>(context.spheres, touch, memory_.recall(slot), triple<double>(contact.force));
    system_.tie(unknown, k, -touch.arm * touch.normal);
    unknown.nodes = context.boundary.features()[contact.feature].nodes;
    unknown.weights = {contact.weights.a, contact.weights.b, contact.weights.c};
    if (touch.has_saddle) {
      const Weights& w = contact.saddle.weights;
      unknown.saddle_normal = touch.saddle_normal;
      unknown.saddle_nodes = context.boundary.features()[contact.saddle.feature].nodes;
      unknown.saddle_weights = {w.a, w.b, w.c};
    }
    system_.add(unknown, relative_velocity<Law>(context.spheres, touch));
  }

  /// The sphere's contact of the last step that this one continues: the same part's, with the nearest normal;
  /// empty, of part -1, where there is none.
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

  void evaluate_contact(const Context& context, Index k, Index slot, const Triple<double>& velocity_gain,
                        ContactWork& work) noexcept {
    BoundaryContact& contact = context.list.contacts()[slot];
    Memory memory = memory_.recall(slot);
    evaluate(context, context.list.spheres()[k], contact, velocity_gain, memory, work);
    memory_.remember(slot, memory);
  }

  static RigidTouch rigid_touch(const Context& context, Index i, const BoundaryContact& contact) noexcept {
    const Feature& feature = context.boundary.features()[contact.feature];
    const double radius = context.spheres.position[i].w, wire = feature.wire_radius;
    const FeatureSaddle& saddle = contact.saddle;
    const bool limited = saddle.feature >= 0;
    return {.sphere = i,
            .normal = triple<double>(contact.normal),
            .overlap = contact.reach - contact.normal.w,
            .arm = limited ? contact.normal.w : radius - (contact.reach - contact.normal.w),
            // A thin wire presses deeper than a flat face: R* of crossed cylinders, sqrt(R R r/(R + r)).
            .reduced_radius = wire > 0 ? std::sqrt(radius * radius * wire / (radius + wire)) : radius,
            .area = contact_area(context.spheres, i, triple<double>(contact.normal), wire),
            .partner_velocity = context.boundary.velocity_at(feature, contact.weights),
            .velocity_gain = {},
            .parameters = &context.table(context.spheres.material[i], feature.material),
            .has_saddle = limited,
            .saddle_normal = saddle.normal,
            .saddle_velocity = limited ? context.boundary.velocity_at(
                                             context.boundary.features()[saddle.feature], saddle.weights)
                                       : Triple<double>{}};
  }

  /// m^2; a wire covers a strip of the sphere's share of the surface, so that what a wire along a rock meets is its own
  /// width times its length however finely the rock is filled.
  static double contact_area(const Spheres& spheres, Index i, const Triple<double>& normal,
                             double wire_radius) noexcept {
    if constexpr (Law::spreads_over_area) {
      const double seen = seen_area<double>(spheres.facing[i], normal),
                   width = std::sqrt(spheres.facing[i].w);
      return wire_radius > 0 ? seen * std::min(1.0, 2 * wire_radius / width) : seen;
    } else {
      return 0;
    }
  }

  static void evaluate(const Context& context, Index i, BoundaryContact& contact,
                       const Triple<double>& velocity_gain, Memory& memory, ContactWork& work) noexcept {
    RigidTouch touch = rigid_touch(context, i, contact);
    touch.velocity_gain = velocity_gain;
    if constexpr (Law::has_ledger)
      work += work_of_last_pull(context, i, contact, touch, Law::dashpot_force(memory));
    const auto [force, pull] =
        evaluate_rigid_contact<Law>(context.spheres, touch, context.step, memory, work);
    if constexpr (Law::has_ledger)
      work.boundary += 0.5 * context.step *
                       (dot(triple<double>(contact.force) + force, touch.partner_velocity) +
                        (touch.has_saddle ? dot(pull, touch.saddle_velocity) : 0.0));
    contact.force = row(force);
    contact.pull = pull;
  }

  /// What the pull of the last evaluation does over the step behind: at the saddle it was directed to, which may have become
  /// another since, as has what the dashpot's way counts along.
  static ContactWork work_of_last_pull(const Context& context, Index i, const BoundaryContact& contact,
                                       const RigidTouch& touch, double dashpot_force) noexcept {
    const FeatureSaddle& last = contact.pulled;
    if (last.feature < 0 && !touch.has_saddle) return {};
    const Triple<double> v = triple<double>(context.spheres.velocity[i]);
    const auto way = [&](const Triple<double>& normal, const Triple<double>& velocity) {
      return dot(v - velocity, normal);
    };
    ContactWork work;
    double before = 0;
    if (last.feature >= 0) {
      const Triple<double> velocity =
          context.boundary.velocity_at(context.boundary.features()[last.feature], last.weights);
      before = way(last.normal, velocity);
      work.boundary = 0.5 * context.step * dot(contact.pull, velocity);
    }
    const double now = touch.has_saddle ? way(touch.saddle_normal, touch.saddle_velocity) : 0;
    work.damping = -0.5 * context.step * dashpot_force * (now - before);
    return work;
  }

  /// The last half step's work of a contact that is gone: zero force now, at the same place.
  void end_contact(const Context& context, Index i, OldContact& ended, ContactWork& work) noexcept {
    if constexpr (Law::has_ledger)  // a wire that breaks takes what pressed it away
      if (context.boundary.is_lost(ended.contact.feature)) work.damping += Law::stored_energy(ended.memory);
    ended.contact.normal.w = ended.contact.reach;
    ended.contact.pulled = ended.contact.saddle;
    evaluate(context, i, ended.contact, {}, ended.memory, work);
  }

  /// One after the other, so that a node's reactions add up in the same order for any number of threads.
  static void collect_reactions(const Context& context) noexcept {
    context.boundary.clear_reactions();
    for_each_contact(context, [&](Index, Index slot) {
      const BoundaryContact& contact = context.list.contacts()[slot];
      context.boundary.react(context.boundary.features()[contact.feature], contact.weights,
                             triple<double>(contact.force));
      if (contact.saddle.feature >= 0)
        context.boundary.react(context.boundary.features()[contact.saddle.feature], contact.saddle.weights,
                               contact.pull);
    });
  }

  std::vector<Scratch> scratch_;  ///< one a task
  ImplicitSystem system_;         ///< empty where contacts are explicit
};

}  // namespace talus::dem
