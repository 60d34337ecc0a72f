// work.hpp: work of the forces of a contact along a path, and its stored energy.
//
//   friction  T dp     surface  -T ds     damping  cn g' dg     applied_normal_force  -N dt
//   stored    (N - cn g')^2 / 2 kn  closed,   kn g^2 / 2  inside,   T^2 / 2 kt
//
// In state inside (a dashpot has opened the contact although g < 0) there is no contact force. The dashpot dissipates the
// energy that the spring releases, kn (g_from^2 - g_to^2)/2, until the gap opens or the contact closes again.
#pragma once

#include "contact/contact_states.hpp"

namespace signorini::contact {

/// Work of a contact with Coulomb friction.
[[nodiscard]] inline ContactWork coulomb_work(const Contact& contact, State state, double N, double T,
                                              const ContactIncrement& path) {
  ContactWork work;
  if (slip_sign(state) != 0) work.friction = T * path.slip;
  work.surface = -T * path.surface;
  if (!is_open(state)) work.damping = contact.normal_damping * path.gap_rate * path.gap;
  work.applied_normal_force = -N * path.time;
  return work;
}

// Engines evaluate the next two functions at each step of each contact: contacts with Coulomb friction, which most are,
// are computed without a virtual call.

/// Work of the contact forces N and T during the increment `path`, for a contact in this state.
[[nodiscard]] inline ContactWork work_on(const Contact& contact, State state, double N, double T,
                                         const ContactIncrement& path) {
  return contact.obeys_coulomb() ? coulomb_work(contact, state, N, T, path)
                                 : contact.law->work(contact, state, N, T, path);
}

/// Rate of ContactIncrement::slip: p' in a slipping state, ut' for a user-defined law, otherwise 0.
[[nodiscard]] inline double working_slip_rate(const Contact& contact, State state, const ContactMotion& m) {
  return contact.obeys_coulomb() && slip_sign(state) == 0 ? 0.0
                                                          : contact.law->working_slip_rate(contact, state, m);
}

/// Energy dissipated by the dashpot of a contact in state `inside` while the gap changes from gap_from to gap_to; 0 in any
/// other state.
[[nodiscard]] double dashpot_loss_inside(const Contact& contact, State state, double gap_from, double gap_to);

/// True if the sliding point jumps whenever its force jumps: the shear element has no dashpot, or the body at the sliding point
/// also moves instantaneously.
[[nodiscard]] bool slides_instantaneously(const Contact& contact);

/// Energy stored in the tangential spring. 0 for a shear element, because its spring belongs to the structure.
[[nodiscard]] double shear_energy(const Contact& contact, double T);
/// Energy stored in the springs of the contact, along the normal and along the tangent (see shear_energy()).
[[nodiscard]] double stored_energy(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini::contact
