// undamped_motion.hpp: motions without mass that the dashpots of a contact state do not resist.
//
//   d_k . z = 0,  z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p
//
// d_k: the velocity in a row of the contact state (kn g + cn g': g'), on degrees of freedom with neither mass nor
// damper. As many of them as there are independent d_k are damped; every other one, p, represents a motion z along
// which forces are in equilibrium instantaneously, whatever the angle of d_k with the axes. Motions that the structure
// itself leaves undamped: model/massless.hpp.
#pragma once

#include <utility>
#include <vector>

#include "contact/law.hpp"
#include "linear/unknowns.hpp"
#include "signorini/model.hpp"

namespace signorini::linear {

// Motions of degrees of freedom that a single contact prescribes.
//
//   n . x = r,  t . x = q      rows g'' = 0 and ut'' = s'' of one contact, and likewise for velocities
//   x_i = (a r + b q)/d        forms of a single term each, or both of the same two degrees of freedom
//
// Such degrees of freedom are set exactly, not to the rounding of an elimination: there is no drift, and a body held
// still on an incline does not move at all, as on level ground.

/// A degree of freedom whose acceleration a contact's rows prescribe: (normal r + tangent q)/divisor.
struct PrescribedDof {
  std::size_t dof = 0, contact = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// rows: one entry for each contact.
[[nodiscard]] std::vector<PrescribedDof> prescribed_dofs(const Model& model, const std::vector<Rows>& rows);

/// Sets x such that form . x = value exactly, if the form has a single term; else x is unchanged.
void set_exactly(const Combination& form, double value, Vector& x);
/// Sets both n . x = r and t . x = q, if the forms have a single term each or the same two.
void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x);

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
[[nodiscard]] MotionKinds kinds_in_states(const std::vector<DofKind>& own, const Model& model,
                                          const std::vector<Rows>& rows);

/// Lists of degrees of freedom that may occur in one such motion together, in any contact state; single ones are not
/// listed.
[[nodiscard]] std::vector<std::vector<int>> undamped_together(const std::vector<DofKind>& own,
                                                              const Model& model);

}  // namespace signorini::linear
