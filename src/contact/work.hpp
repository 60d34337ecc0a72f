// work.hpp: what the forces of a contact do along a path, and what it stores.
//
//   friction  T dp     surface  -T ds     damping  cn g' dg     pressing  -N dt
//   stored    (N - cn g')^2 / 2 kn  closed,   kn g^2 / 2  inside,   T^2 / 2 kt
//
// A contact that a dashpot has opened while g < 0 (inside) carries nothing: its dashpot takes what its
// spring gives, kn (g_from^2 - g_to^2)/2, until the gap opens or it closes again.
#pragma once

#include "contact/mode.hpp"

namespace signorini {

/// A small piece of a contact's path, or the same by time (dt = 1): increments, and g' on it.
struct ContactPath {
  double slip = 0.0, surface = 0.0, gap = 0.0;  ///< dp, ds, dg
  double gap_rate = 0.0;                        ///< g'
  double time = 0.0;                            ///< dt
};

/// Of a law of one's own `friction` is all that it takes, stored or lost, and the path's slip is d ut.
/// Unit: energy, but pressing: force * time. By time where the path is.
struct ContactWork {
  double friction = 0.0, surface = 0.0, damping = 0.0, pressing = 0.0;
};

/// N, T: on the path, of a contact in this state.
[[nodiscard]] ContactWork work_on(const Contact& contact, State state, double N, double T,
                                  const ContactPath& path);

/// The slip rate of ContactPath::slip by time: p' of a state that slips, ut' of a law that is not Coulomb's; else 0.
[[nodiscard]] double working_slip_rate(const Contact& contact, State state, const ContactMotion& m);

/// What the dashpot of a contact that is inside takes between two gaps; 0 in any other state.
[[nodiscard]] double inside_loss(const Contact& contact, State state, double gap_from, double gap_to);

/// Its sliding point jumps where its force does: the dashpot beside it holds no body that follows at once, or there is none.
[[nodiscard]] bool slides_at_once(const Contact& contact);

/// Of its springs.
[[nodiscard]] double shear_energy(const Contact& contact, double T);
[[nodiscard]] double stored_energy(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini
