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

/// Laws without dashpots are laws of rocks, for which the sum of the balls' rolling resistances means nothing.
template <class Normal, class Ledger>
struct CombinationsWithoutRolling {
  template <class Friction>
  using Model = ContactModel<ContactLaw<Normal, Friction, NoTerm, Ledger>>;
  using Types = std::tuple<Model<NoTerm>, Model<Friction>, Model<FallingFriction>>;
};

template <class Tuple>
struct VariantOf;
template <class... Models>
struct VariantOf<std::tuple<Models...>> {
  using Type = std::variant<Models...>;
};
template <class... Combinations>
using AnyOf =
    typename VariantOf<decltype(std::tuple_cat(std::declval<typename Combinations::Types>()...))>::Type;

/// The chosen model. A scene without friction, rolling resistance or ledger runs code that does not contain
/// them.
using AnyContactModel =
    AnyOf<Combinations<Hertz, NoTerm>, Combinations<Hertz, WorkLedger>, Combinations<LinearSpring, NoTerm>,
          Combinations<LinearSpring, WorkLedger>, CombinationsWithoutRolling<HystereticHertz, NoTerm>,
          CombinationsWithoutRolling<HystereticHertz, WorkLedger>,
          CombinationsWithoutRolling<Foundation, NoTerm>, CombinationsWithoutRolling<Foundation, WorkLedger>>;

/// The terms that a scene names.
struct LawChoice {
  enum class Normal { hertz, linear, hysteretic_hertz, foundation } normal = Normal::hertz;
  enum class FrictionKind { none, constant, falling } friction = FrictionKind::none;
  enum class Rolling { none, constant_torque, elastic_plastic } rolling = Rolling::none;
  bool ledger = false;

  bool rotation() const noexcept { return friction != FrictionKind::none; }
  bool spreads_over_area() const noexcept { return normal == Normal::foundation; }
  /// Whether contacts lose energy by unloading on another curve, without dashpots.
  bool hysteretic() const noexcept {
    return normal == Normal::hysteretic_hertz || normal == Normal::foundation;
  }
  bool operator==(const LawChoice&) const = default;
};

/// @throws UsageError for rolling resistance without friction, or with a law without dashpots.
AnyContactModel make_contact_model(const LawChoice& choice);

}  // namespace talus::dem
