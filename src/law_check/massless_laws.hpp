// massless_laws.hpp: error of the velocities of massless parts due to rounding of forces.
//
//   Y^T C v = Y^T (P - K u - F)      rows with damping determine v from forces
//   Z^T K v = Z^T (P' - ... - F')    Z: left null vectors of C; rows without damping determine v from rates of forces
//                                    Y: orthogonal complement of Z
//
//   |d(f . v)| <= sum_j |x_j| sum_i |(Y, Z)_ij| noise_i,   S^T x = f,   S = (Y^T C, Z^T K)
//
// C and K: on massless degrees of freedom, with the dashpots and springs of closed contacts. A node may have both kinds
// of rows: with an oblique damper, or with the dashpot of a sliding contact, one combination of its rows is undamped.
//
// A massless part at rest under forces of size F has velocities of about eps F/C, from whose signs no direction of slip
// can be concluded. Unit of d(f . v): length/time.
#pragma once

#include "law_check/laws.hpp"

namespace signorini::law_check {

/// Uncertainty of the slip rate of contact k in its state on this side. 0: the contact acts only on degrees of freedom with
/// mass, or the massless rows do not determine velocities because a contact sticks rigidly; 0 also if dampers couple more
/// than 300 massless rows.
[[nodiscard]] double slip_rate_noise(const CheckContext& context, const CheckedSide& side, std::size_t k);

}  // namespace signorini::law_check
