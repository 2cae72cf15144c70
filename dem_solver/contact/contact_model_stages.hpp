#pragma once

#include "dem_solver/contact/contact_model.hpp"

/// The members of ContactModel, for the files that compile them.
namespace talus::dem {

template <class Law>
void ContactModel<Law>::rebuild(const ContactStage& stage, const ContactMoves& moves) {
  pairs_.rebuild(stage.pair_list, moves.pairs);
  planes_.rebuild(stage.plane_list, moves.planes);
  boundary_.rebuild(stage.boundary_list, moves.boundary);
}

template <class Law>
int ContactModel<Law>::evaluate(const ContactStage& s) noexcept {
  pairs_.evaluate({s.spheres, s.pair_list, s.table, s.step, s.threads});
  core::lap(s.clock, between_spheres);
  if (!s.planes.empty()) planes_.evaluate({s.spheres, s.planes, s.plane_list, s.table, s.step, s.threads});
  core::lap(s.clock, with_planes);
  if (s.boundary.empty()) return 0;
  const typename BoundaryContacts<Law>::Context context{s.spheres, s.boundary, s.boundary_list,
                                                        s.table,   s.step,     s.threads};
  // After all other loads: implicit contact starts from the velocities they lead to.
  if (s.implicit_contact)
    return boundary_.evaluate_implicitly(context, *s.implicit_contact,
                                         {s.spheres, s.rocks, s.place, s.boundary});
  boundary_.evaluate(context);
  return 0;
}

template <class Law>
ContactWork ContactModel<Law>::last_work() const noexcept {
  ContactWork work;
  if constexpr (Law::has_ledger) {
    work += pairs_.last_work();
    work += planes_.last_work();
    work += boundary_.last_work();
  }
  return work;
}

template <class Law>
double ContactModel<Law>::stored_energy() const noexcept {
  if constexpr (Law::has_ledger)
    return pairs_.stored_energy() + planes_.stored_energy() + boundary_.stored_energy();
  else
    return 0;
}

}  // namespace talus::dem
