// rounding_floor.hpp: accuracy limit of the lowest frequency due to the rounding of the matrices.
//
//   delta omega^2 = x^T dK x,   |dK_ij| <= eps/2 |K_ij|, irregular:   delta omega / omega = eps/4 sqrt( sum (x_i K_ij x_j)^2 ) / x^T K x
//
// Entries of K are rounded during assembly, and x^T K x is a small difference of large terms: on a mesh of n elements
// the loss is of order n^3 or more. Neither a smaller tolerance nor another engine removes it; times of events have the
// same error.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Relative, for the mode with the frequency closest to model.omega1, with contact springs; 0: there is none.
[[nodiscard]] double rounding_floor(const Model& model);

}  // namespace signorini
