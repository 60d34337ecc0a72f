// undamped_motion.hpp: motions without mass that the dashpots of a contact state do not resist.
//
//   d_k . z = 0,  z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p
//
// d_k: the form of the velocity in a row of the contact state, such as g' in kn g + cn g'. It contains only
// degrees of freedom with neither mass nor damper. As many of these as there are independent d_k count as
// damped. Every other one, p, represents a motion z along which forces are in equilibrium at every instant.
// Motions that the structure itself leaves undamped: model/massless.hpp.
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
// Such degrees of freedom are set exactly, without the rounding of an elimination. So there is no drift, and
// a body at rest on an incline does not move at all, as on level ground.

/// A degree of freedom whose acceleration a contact's rows prescribe: (normal r + tangent q)/divisor.
struct PrescribedDof {
  std::size_t dof = 0, contact = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// All degrees of freedom that the rows prescribe; rows: one entry for each contact.
[[nodiscard]] std::vector<PrescribedDof> prescribed_dofs(const Model& model, const std::vector<Rows>& rows);

/// Sets x such that form . x = value exactly, if the form has a single term; else x is unchanged.
void set_exactly(const Combination& form, double value, Vector& x);
/// Sets x such that n . x = r and t . x = q exactly, if the forms have a single term each or the same two
/// degrees of freedom; else x is unchanged.
void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x);

/// A motion z without mass and damping.
struct UndampedMotion {
  int dof = 0;                                 ///< p
  std::vector<std::pair<int, double>> others;  ///< damped degrees of freedom, and z there
};

/// Kind of each unknown in the equations of a contact state, and the undamped massless motions of that state.
struct MotionKinds {
  std::vector<DofKind> kinds;  ///< one for each degree of freedom
  std::vector<UndampedMotion> undamped;
};

/// Kinds and motions in a contact state with these rows. own: kinds by the structure alone (dof_kinds).
[[nodiscard]] MotionKinds kinds_in_states(const std::vector<DofKind>& own, const Model& model,
                                          const std::vector<Rows>& rows);

/// Lists of two or more degrees of freedom that may occur together in one UndampedMotion, in any contact
/// state.
[[nodiscard]] std::vector<std::vector<int>> undamped_together(const std::vector<DofKind>& own,
                                                              const Model& model);

}  // namespace signorini::linear
