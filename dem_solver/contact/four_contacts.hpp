#pragma once

#include <algorithm>
#include <vector>

#include "dem_solver/contact/law.hpp"
#include "dem_solver/contact/materials.hpp"

/// Four contacts seen as lanes: what they read of the arrays, and what they add to them.
namespace talus::dem {

/// The rows that place(k) of the four contacts name.
template <class Place>
TALUS_INLINE Quad<Lanes> gathered(const std::vector<Row>& rows, const Place& place) noexcept {
  return transposed(load(rows[place(0)]), load(rows[place(1)]), load(rows[place(2)]), load(rows[place(3)]));
}

/// Adds to the rows that place(k) of the first `active` contacts name, one after the other: two of them may
/// name the same.
template <class Place>
TALUS_INLINE void scatter(std::vector<Row>& rows, const Place& place, int active, const Triple<Lanes>& added,
                          Lanes fourth = Lanes{}) noexcept {
  const Quad<Lanes> by_contact = transposed(added.x, added.y, added.z, fourth);
  const Lanes value[] = {by_contact.x, by_contact.y, by_contact.z, by_contact.w};
  for (int k = 0; k < active; ++k) {
    Row& to = rows[place(k)];
    store(to, load(to) + value[k]);
  }
}

/// @param of of(k): the parameters of the k-th contact
template <class Law, class Of>
TALUS_INLINE ContactParameters<Lanes> gathered_parameters(const Of& of) noexcept {
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

/// Calls evaluate(four, active) for the contacts in groups of four. The last group is filled up with its own
/// last contact, whose results are not to be stored. @pre room for four more than `count`
template <class Contact, class Evaluate>
TALUS_INLINE void in_fours(Contact* contacts, int count, const Evaluate& evaluate) noexcept {
  for (int k = 0; k < lane_count; ++k) contacts[count + k] = contacts[count > 0 ? count - 1 : 0];
  for (int k = 0; k < count; k += lane_count) evaluate(contacts + k, std::min(count - k, lane_count));
}

}  // namespace talus::dem
