// pinned.hpp: motions of degrees of freedom that a single contact prescribes.
//
//   n . x = r,  t . x = q      rows g'' = 0 and ut'' = s'' of one contact, and likewise for velocities
//   x_i = (a r + b q)/d        forms of a single term each, or both of the same two degrees of freedom
//
// Such degrees of freedom are set exactly, not to the rounding of an elimination: there is no drift, and a body held
// still on an incline does not move at all, as on level ground.
#pragma once

#include <vector>

#include "contact/law.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A degree of freedom whose acceleration a contact's rows prescribe: (normal r + tangent q)/divisor.
struct Pinned {
  std::size_t dof = 0, contact = 0;
  double normal = 0.0, tangent = 0.0, divisor = 1.0;
};

/// rows: one entry for each contact.
[[nodiscard]] std::vector<Pinned> pinned_by(const Model& model, const std::vector<Rows>& rows);

/// Sets x such that form . x = value exactly, if the form has a single term; else x is unchanged.
void set_exactly(const Combination& form, double value, Vector& x);
/// Sets both n . x = r and t . x = q, if the forms have a single term each or the same two.
void set_exactly(const Combination& n, double r, const Combination& t, double q, Vector& x);

}  // namespace signorini
