// undamped_motion.hpp: massless motions that the dashpots of a contact state do not damp.
//
//   d_k . z = 0,  z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p          u': unknowns that replace u
//
// d_k: form of the velocity in a row of the contact state, such as g' in kn g + cn g', restricted to degrees of freedom with
// neither mass nor damper. The state damps as many of these degrees of freedom as there are independent d_k. Each undamped
// one, p, represents a motion z along which forces are in equilibrium at every instant. For motions that the dampers of the
// structure do not damp see model/massless.hpp.
#pragma once

#include <utility>
#include <vector>

#include "contact/law.hpp"
#include "linear/unknowns.hpp"
#include "signorini/model.hpp"

namespace signorini::linear {

// Motions of degrees of freedom that a single contact prescribes.
//
//   n . x = r,  t . x = q      rows g'' = 0 and ut'' = s'' of one contact; the same for velocities
//   x_i = (a r + b q)/d        each form has one term, or both have the same two degrees of freedom
//
// Such degrees of freedom are set exactly, without the rounding errors of an elimination. So there is no drift, and a body at
// rest on an incline does not move at all, like a body on level ground.

/// A degree of freedom whose acceleration the rows of a contact prescribe: (normal r + tangent q)/divisor.
struct PrescribedDof {
  std::size_t dof = 0, contact = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// All degrees of freedom that the rows prescribe. rows: one entry per contact.
[[nodiscard]] std::vector<PrescribedDof> prescribed_dofs(const Model& model, const std::vector<Rows>& rows);

/// Sets x so that form . x = value exactly, if the form has a single term; otherwise x is unchanged.
void set_exactly(const Combination& form, double value, Vector& x);
/// Sets x exactly: n . x = r if n has a single term, t . x = q if t has a single term, and both if n and t consist of the same
/// two degrees of freedom.
void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x);

/// A motion z that has neither mass nor damping; z_dof = 1.
struct UndampedMotion {
  int dof = 0;                                 ///< the representing degree of freedom p
  std::vector<std::pair<int, double>> others;  ///< damped degrees of freedom i, with z_i
};

/// Kind of each degree of freedom in the equations of a contact state, and the undamped massless motions of that state.
struct MotionKinds {
  std::vector<DofKind> kinds;  ///< one entry per degree of freedom
  std::vector<UndampedMotion> undamped;
};

/// Kinds and motions in a contact state with these rows. own: kinds from the structure alone (dof_kinds).
[[nodiscard]] MotionKinds kinds_in_states(const std::vector<DofKind>& own, const Model& model,
                                          const std::vector<Rows>& rows);

/// Lists of two or more degrees of freedom that may occur in the same UndampedMotion in some contact state.
[[nodiscard]] std::vector<std::vector<int>> joint_undamped_dofs(const std::vector<DofKind>& own,
                                                                const Model& model);

}  // namespace signorini::linear
