// Compiles the contact laws on the linear spring; listed in contact_models.hpp.
#include "dem_solver/contact/contact_model_stages.hpp"

namespace talus::dem {

template class ContactModel<ContactLaw<LinearSpring, NoTerm, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, ConstantTorque, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, ElasticPlasticRolling, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, ConstantTorque, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, ElasticPlasticRolling, NoTerm>>;
template class ContactModel<ContactLaw<LinearSpring, NoTerm, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, ConstantTorque, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, Friction, ElasticPlasticRolling, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, ConstantTorque, WorkLedger>>;
template class ContactModel<ContactLaw<LinearSpring, FallingFriction, ElasticPlasticRolling, WorkLedger>>;

}  // namespace talus::dem
