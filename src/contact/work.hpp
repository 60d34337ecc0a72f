// work.hpp: work of the forces of a contact along a path, and its stored energy.
//
//   friction  T dp     surface  -T ds     damping  cn g' dg     applied_normal_force  -N dt
//   stored    (N - cn g')^2 / 2 kn  closed,   kn g^2 / 2  inside,   T^2 / 2 kt
//
// A contact that a dashpot has opened while g < 0 (inside) has no force: its dashpot dissipates the energy that its
// spring releases, kn (g_from^2 - g_to^2)/2, until the gap opens or the contact closes again.
#pragma once

#include "contact/contact_states.hpp"

namespace signorini {

/// Small increments of a contact's path, or rates (dt = 1), together with g' on the path.
struct ContactIncrement {
  double slip = 0.0, surface = 0.0, gap = 0.0;  ///< dp, ds, dg
  double gap_rate = 0.0;                        ///< g'
  double time = 0.0;                            ///< dt
};

/// Works on an increment; powers if it holds rates. For a user-defined law `friction` is the whole work,
/// stored or dissipated, and the slip of the path is d ut. Unit: energy; applied_normal_force: force * time.
struct ContactWork {
  double friction = 0.0, surface = 0.0, damping = 0.0, applied_normal_force = 0.0;
};

}  // namespace signorini

namespace signorini::contact {

/// Work of the forces N, T on the path, for a contact in this state.
[[nodiscard]] ContactWork work_on(const Contact& contact, State state, double N, double T,
                                  const ContactIncrement& path);

/// Rate of ContactIncrement::slip: p' for a slipping state, ut' for a user-defined law; otherwise 0.
[[nodiscard]] double working_slip_rate(const Contact& contact, State state, const ContactMotion& m);

/// Energy dissipated in the dashpot of a contact in state `inside` between two gaps; 0 in any other state.
[[nodiscard]] double inside_loss(const Contact& contact, State state, double gap_from, double gap_to);

/// True if the sliding point jumps when its force does: it has no dashpot, or the body beside it follows
/// instantaneously.
[[nodiscard]] bool slides_instantaneously(const Contact& contact);

/// Energy stored in the tangential spring; 0 with a shear element, whose spring belongs to the structure.
[[nodiscard]] double shear_energy(const Contact& contact, double T);
/// Energy stored in the springs of the contact, along the normal and along the tangent as in shear_energy().
[[nodiscard]] double stored_energy(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini::contact
