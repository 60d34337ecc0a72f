// contact_work.hpp: work of the forces of a contact, and violations of its conditions.
//
//   friction  T dp     surface  -T ds     damping  cn g' dg     applied_normal_force  -N dt
//   (6)  g >= 0, N <= 0, g N = 0          with a normal spring, g is reduced by its deformation (N - cn g')/kn
//   (7)  |T| <= T_U, T p' >= 0            T_U: static limit in stick, friction at the slip rate in slip
//
// Source: Lukashevich et al. 2021, (6) and (7).
#pragma once

namespace signorini {

/// Small increments of the motion of a contact, or rates if time = 1; and the gap rate g' during the increment.
struct ContactIncrement {
  double slip = 0.0, surface = 0.0, gap = 0.0;  ///< dp, ds, dg; for a law with its own states, slip is d ut
  double gap_rate = 0.0;                        ///< g'
  double time = 0.0;                            ///< dt
};

/// Work during an increment; power if the increment contains rates. For a law with its own states `friction` is the whole
/// work, stored or dissipated. Unit: energy; applied_normal_force: force * time.
struct ContactWork {
  double friction = 0.0, surface = 0.0, damping = 0.0, applied_normal_force = 0.0;
};

/// Amounts of violation; a value is positive if its condition is violated.
struct Violations {
  double tension = 0.0;  ///< N; positive in tension; force
  double gap = 0.0;      ///< -(g - deformation of the spring); length; only for contacts with a normal spring
  double penetration = 0.0;  ///< |g| if closed, -g if open; length; only for rigid contacts
  double product = 0.0;      ///< |g N|, with g as in `gap` or `penetration`; energy
  double friction = 0.0;     ///< |T| - T_U of a closed contact; force
  double direction = 0.0;    ///< -T p' of a slipping contact; power
};

}  // namespace signorini
