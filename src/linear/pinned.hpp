// pinned.hpp: motions along one degree of freedom that a contact alone prescribes.
//
//   factor x = value       row g'' = 0 or ut'' = s'', form of a single term
//
// Such a degree of freedom is set exactly, not to the rounding of an elimination: no drift.
#pragma once

#include <vector>

#include "contact/law.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A degree of freedom whose acceleration a row prescribes.
struct Pinned {
  std::size_t dof = 0, contact = 0;
  double factor = 1.0;
  bool tangent = false;  ///< by the tangent row, else by the normal one
};

/// rows: one entry a contact.
[[nodiscard]] std::vector<Pinned> pinned_by(const Model& model, const std::vector<Rows>& rows);

/// x such that form . x = value to the last digit, where the form has a single term; else x as it is.
void set_exactly(const Combination& form, double value, Vector& x);

}  // namespace signorini
