// rounding_floor.hpp: how well the lowest frequency of matrices in double can be known at all.
//
//   delta omega^2 = x^T dK x,   |dK_ij| <= eps/2 |K_ij|, irregular:   delta omega / omega = eps/4 sqrt( sum (x_i K_ij x_j)^2 ) / x^T K x
//
// Entries of K are rounded when elements are added up, and x^T K x is a small difference of great terms: on a
// mesh of n elements that loses n^3 and more. Neither a finer tolerance nor another engine undoes it; times of
// events share in it.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Relative, of the mode whose frequency is next to model.omega1, contacts held by their springs; 0: there is none.
[[nodiscard]] double rounding_floor(const Model& model);

}  // namespace signorini
