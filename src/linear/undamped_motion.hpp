// undamped_motion.hpp: motions without mass that the dashpots of a contact state do not resist.
//
//   d_k . z = 0,  z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p
//
// d_k: the velocity in a row of the contact state (kn g + cn g': g'), on degrees of freedom with neither mass nor
// damper. As many of them as there are independent d_k are damped; every other one, p, represents a motion z along
// which forces are in equilibrium instantaneously, whatever the angle of d_k with the axes. Motions that the structure
// itself leaves undamped: model/undamped.hpp.
#pragma once

#include <utility>
#include <vector>

#include "linear/dof_kinds.hpp"

namespace signorini {

struct UndampedMotion {
  int dof = 0;                                 ///< p
  std::vector<std::pair<int, double>> others;  ///< damped ones, and z there
};

/// Kind of each unknown in the equations of a contact state, and its undamped massless motions.
struct MotionKinds {
  std::vector<DofKind> kinds;  ///< one for each degree of freedom
  std::vector<UndampedMotion> undamped;
};

/// `own`: kinds by the structure alone (dof_kinds).
[[nodiscard]] MotionKinds kinds_in_mode(const std::vector<DofKind>& own, const Model& model,
                                        const std::vector<Rows>& rows);

/// Lists of degrees of freedom that may occur in one such motion together, in any contact state; single ones are not
/// listed.
[[nodiscard]] std::vector<std::vector<int>> undamped_together(const std::vector<DofKind>& own,
                                                              const Model& model);

}  // namespace signorini
