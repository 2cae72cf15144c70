// Compiles the contact laws without dashpots; listed in contact_models.hpp.
#include "dem_solver/contact/contact_model_stages.hpp"

namespace talus::dem {

template class ContactModel<ContactLaw<HystereticHertz, NoTerm, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<HystereticHertz, Friction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<HystereticHertz, FallingFriction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<HystereticHertz, NoTerm, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<HystereticHertz, Friction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<HystereticHertz, FallingFriction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Foundation, NoTerm, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Foundation, Friction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Foundation, FallingFriction, NoTerm, NoTerm>>;
template class ContactModel<ContactLaw<Foundation, NoTerm, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Foundation, Friction, NoTerm, WorkLedger>>;
template class ContactModel<ContactLaw<Foundation, FallingFriction, NoTerm, WorkLedger>>;

}  // namespace talus::dem
