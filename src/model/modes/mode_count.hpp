// mode_count.hpp: how many modes lie below a frequency, without finding any of them.
//
//   number of omega_i^2 < s  =  number of negative pivots of  K - s M = L D L^T
//
// Sylvester's law of inertia. Massless degrees of freedom, on which K is positive definite, have no negative
// pivots of their own. Source: Bathe, Finite Element Procedures, section 11.4 (Sturm sequence check).
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Multiplicities and free motions count. `square` = s > 0; where K - s M is singular to rounding, the count
/// is taken up to 1e-5 of s above it. -1: no factorisation near s is accurate.
[[nodiscard]] int modes_below(const SparseMatrix& mass, const SparseMatrix& stiffness, double square);

}  // namespace signorini
