// Compiles the contact laws on Hertz's spring; listed in contact_models.hpp.
#include "dem_solver/contact/contact_model_stages.hpp"

namespace talus::dem {

template class ContactModel<ContactLaw<Hertz, NoTerm, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, Friction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, Friction, ConstantTorque, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, Friction, ElasticPlasticRolling, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, ConstantTorque, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, ElasticPlasticRolling, NoTerm>>;
template class ContactModel<ContactLaw<Hertz, NoTerm, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, Friction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, Friction, ConstantTorque, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, Friction, ElasticPlasticRolling, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, ConstantTorque, WorkLedger>>;
template class ContactModel<ContactLaw<Hertz, FallingFriction, ElasticPlasticRolling, WorkLedger>>;

}  // namespace talus::dem
