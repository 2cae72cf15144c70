#pragma once

#include "dem_solver/contact/contact_model.hpp"

/// The members of ContactModel, for the files that compile them.
namespace talus::dem {

template <class Law>
ContactModel<Law>::ContactModel() = default;
template <class Law>
ContactModel<Law>::ContactModel(const ContactModel& other) = default;
template <class Law>
ContactModel<Law>::ContactModel(ContactModel&& other) noexcept = default;
template <class Law>
ContactModel<Law>& ContactModel<Law>::operator=(const ContactModel& other) = default;
template <class Law>
ContactModel<Law>& ContactModel<Law>::operator=(ContactModel&& other) noexcept = default;
template <class Law>
ContactModel<Law>::~ContactModel() = default;

template <class Law>
void ContactModel<Law>::rebuild(const ContactStage& stage, const ContactMoves& moves) {
  pairs_.rebuild(stage.pair_list, moves.pairs);
  planes_.rebuild(stage.plane_list, moves.planes);
  boundary_.rebuild(stage.boundary_list, moves.boundary);
}

template <class Law>
void ContactModel<Law>::between_spheres(const ContactStage& s, Index block) noexcept {
  pairs_.evaluate_block({s.spheres, s.pair_list, s.table, s.step}, block);
}

template <class Law>
void ContactModel<Law>::between_distant_spheres(const ContactStage& s) noexcept {
  pairs_.evaluate_wide({s.spheres, s.pair_list, s.table, s.step});
}

template <class Law>
void ContactModel<Law>::with_planes(const ContactStage& s, Index block) noexcept {
  planes_.evaluate_block({s.spheres, s.planes, s.plane_list, s.table, s.step}, block);
}

template <class Law>
int ContactModel<Law>::with_boundary(const ContactStage& s) noexcept {
  const typename BoundaryContacts<Law>::Context context{s.spheres,      s.boundary, s.boundary_list, s.table,
                                                        s.contact_rule, s.step,     s.threads};
  if constexpr (Law::has_dashpots)
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
