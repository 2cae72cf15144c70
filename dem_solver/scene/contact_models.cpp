#include "dem_solver/scene/contact_models.hpp"

#include "core/errors.hpp"

namespace talus::dem {

namespace {

template <class Normal, class Ledger, class FrictionTerm>
AnyContactModel with_rolling(LawChoice::Rolling rolling) {
  if constexpr (Normal::memory_rows > 0) {
    if (rolling != LawChoice::Rolling::none)
      throw core::UsageError("rolling resistance needs a normal law with dashpots");
    return ContactModel<ContactLaw<Normal, FrictionTerm, NoTerm, Ledger>>{};
  } else
    switch (rolling) {
      case LawChoice::Rolling::constant_torque:
        return ContactModel<ContactLaw<Normal, FrictionTerm, ConstantTorque, Ledger>>{};
      case LawChoice::Rolling::elastic_plastic:
        return ContactModel<ContactLaw<Normal, FrictionTerm, ElasticPlasticRolling, Ledger>>{};
      case LawChoice::Rolling::none:
        break;
    }
  return ContactModel<ContactLaw<Normal, FrictionTerm, NoTerm, Ledger>>{};
}

template <class Normal, class Ledger>
AnyContactModel with_friction(const LawChoice& choice) {
  switch (choice.friction) {
    case LawChoice::FrictionKind::constant:
      return with_rolling<Normal, Ledger, Friction>(choice.rolling);
    case LawChoice::FrictionKind::falling:
      return with_rolling<Normal, Ledger, FallingFriction>(choice.rolling);
    case LawChoice::FrictionKind::none:
      break;
  }
  if (choice.rolling != LawChoice::Rolling::none)
    throw core::UsageError("rolling resistance needs friction, which turns the spheres");
  return ContactModel<ContactLaw<Normal, NoTerm, NoTerm, Ledger>>{};
}

template <class Normal>
AnyContactModel with_ledger(const LawChoice& choice) {
  return choice.ledger ? with_friction<Normal, WorkLedger>(choice) : with_friction<Normal, NoTerm>(choice);
}

}  // namespace

AnyContactModel make_contact_model(const LawChoice& choice) {
  switch (choice.normal) {
    case LawChoice::Normal::linear:
      return with_ledger<LinearSpring>(choice);
    case LawChoice::Normal::hysteretic_hertz:
      return with_ledger<HystereticHertz>(choice);
    case LawChoice::Normal::foundation:
      return with_ledger<Foundation>(choice);
    case LawChoice::Normal::hertz:
      break;
  }
  return with_ledger<Hertz>(choice);
}

}  // namespace talus::dem
