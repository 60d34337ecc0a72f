// massless_laws.hpp: effect of rounding on the velocities of massless parts.
//
//   Y^T C v = Y^T (P - K u - F)      Y: complement of Z               rounding of forces, divided by C
//   Z^T K v = Z^T (P' - ... - F')    Z: left vectors with Z^T C = 0   rounding of rates of forces, divided by K
//
//   |d(f . v)| <= sum_j |x_j| sum_i |(Y, Z)_ij| noise_i,   S^T x = f,   S = (Y^T C, Z^T K)
//
// C and K: on massless degrees of freedom, with the dashpots and springs of closed contacts. With a damper in an
// oblique direction at a node, or with the dashpot of a sliding contact, one combination of the node's rows contains K
// only.
//
// A part at rest under forces of size F has velocities of rounding size, eps F/C. They do not determine a direction of
// slip. Unit: that of f . v, length/time.
#pragma once

#include "law_check/laws.hpp"

namespace signorini::law_check {

/// Uncertainty of the slip rate of contact k in its state on this side. 0: the contact acts on mass, or the
/// rows of its massless parts do not determine their velocities. This is so if a contact sticks rigidly, or
/// if dampers couple more than 300 rows.
[[nodiscard]] double slip_rate_noise(const CheckContext& context, const CheckedSide& side, std::size_t k);

}  // namespace signorini::law_check
