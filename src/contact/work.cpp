#include "contact/work.hpp"

namespace signorini::contact {

double dashpot_loss_inside(const Contact& contact, State state, double gap_from, double gap_to) {
  if (state != State::inside) return 0.0;
  return 0.5 * contact.normal_stiffness * (gap_from - gap_to) * (gap_from + gap_to);
}

bool slides_instantaneously(const Contact& contact) {
  if (!contact.shear) return false;
  // The form has several terms if the body at the sliding point is massless (model/rigid_contacts.cpp).
  return contact.shear->damping == 0.0 || contact.tangent.terms.size() > 1;
}

double shear_energy(const Contact& contact, double T) {
  const std::optional<double> kt = contact.anchor_spring();
  return kt ? T * T / (2.0 * *kt) : 0.0;
}

double stored_energy(const Contact& contact, State state, const ContactMotion& m) {
  return contact.law->stored_energy(contact, state, m);
}

}  // namespace signorini::contact
