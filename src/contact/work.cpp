#include "contact/work.hpp"

namespace signorini {

ContactWork work_on(const Contact& contact, State state, double N, double T, const ContactPath& path) {
  ContactWork work;
  if (contact.own) {
    work.friction = N * path.gap + T * path.slip;
    work.surface = -T * path.surface;
    work.pressing = -N * path.time;
    return work;
  }
  if (slip_sign(state) != 0) work.friction = T * path.slip;
  work.surface = -T * path.surface;
  if (!is_open(state)) work.damping = contact.normal_damping * path.gap_rate * path.gap;
  work.pressing = -N * path.time;
  return work;
}

double inside_loss(const Contact& contact, State state, double gap_from, double gap_to) {
  if (state != State::inside) return 0.0;
  return 0.5 * contact.normal_stiffness * (gap_from - gap_to) * (gap_from + gap_to);
}

bool slides_at_once(const Contact& contact) {
  if (!contact.shear) return false;
  // Beside the point stands the body, where that has no mass (model/shear.cpp).
  return contact.shear->damping == 0.0 || contact.tangent.terms.size() > 1;
}

double shear_energy(const Contact& contact, double T) {
  return contact.tangential_stiffness && !contact.own ? T * T / (2.0 * *contact.tangential_stiffness) : 0.0;
}

double stored_energy(const Contact& contact, State state, const ContactMotion& m) {
  double energy = shear_energy(contact, m.T);
  if (!contact.has_spring() || contact.own) return energy;
  if (state == State::inside) {  // N = 0: the spring is as long as the gap is deep
    energy += 0.5 * contact.normal_stiffness * m.gap * m.gap;
  } else if (!is_open(state)) {
    const double spring = m.N - contact.normal_damping * m.vn;
    energy += spring * spring / (2.0 * contact.normal_stiffness);
  }
  return energy;
}

}  // namespace signorini
