// mode_count.hpp: number of modes below a frequency, without computing them.
//
//   number of omega_i^2 < s  =  number of negative pivots of  K - s M = L D L^T
//
// Sylvester's law of inertia. Massless degrees of freedom, on which K is positive definite, contribute no negative
// pivots. Source: Bathe, Finite Element Procedures, section 11.4 (Sturm sequence check).
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Counts multiplicities and free motions. `square` = s > 0; if K - s M is singular to rounding, modes up to 1e-5 of s
/// above it are counted. -1: no factorisation near s is accurate.
[[nodiscard]] int modes_below(const SparseMatrix& mass, const SparseMatrix& stiffness, double square);

}  // namespace signorini
