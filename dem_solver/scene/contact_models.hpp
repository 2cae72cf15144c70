#pragma once

#include <tuple>
#include <variant>

#include "dem_solver/contact/contact_model.hpp"

/// The contact laws a scene can call for: every combination of terms, listed once.
namespace talus::dem {

template <class Normal, class Ledger>
struct Combinations {
  template <class Friction, class Rolling>
  using Model = ContactModel<ContactLaw<Normal, Friction, Rolling, Ledger>>;
  using Types = std::tuple<Model<NoTerm, NoTerm>,  //
                           Model<Friction, NoTerm>, Model<Friction, ConstantTorque>,
                           Model<Friction, ElasticPlasticRolling>,  //
                           Model<FallingFriction, NoTerm>, Model<FallingFriction, ConstantTorque>,
                           Model<FallingFriction, ElasticPlasticRolling>>;
};

template <class... Tuples>
struct VariantOf;
template <class... A, class... B, class... C, class... D>
struct VariantOf<std::tuple<A...>, std::tuple<B...>, std::tuple<C...>, std::tuple<D...>> {
  using Type = std::variant<A..., B..., C..., D...>;
};

/// The chosen model. A scene without friction, rolling resistance or ledger runs code that does not contain
/// them.
using AnyContactModel =
    VariantOf<Combinations<Hertz, NoTerm>::Types, Combinations<Hertz, WorkLedger>::Types,
              Combinations<LinearSpring, NoTerm>::Types, Combinations<LinearSpring, WorkLedger>::Types>::Type;

/// The terms that a scene names.
struct LawChoice {
  enum class Normal { hertz, linear } normal = Normal::hertz;
  enum class FrictionKind { none, constant, falling } friction = FrictionKind::none;
  enum class Rolling { none, constant_torque, elastic_plastic } rolling = Rolling::none;
  bool ledger = false;

  bool rotation() const noexcept { return friction != FrictionKind::none; }
  bool operator==(const LawChoice&) const = default;
};

/// @throws UsageError for rolling resistance without friction.
AnyContactModel make_contact_model(const LawChoice& choice);

}  // namespace talus::dem
