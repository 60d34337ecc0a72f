// massless_rates.hpp: how far rounding moves the velocities of parts without mass.
//
//   Y^T C v = Y^T (P - K u - F)      Y: across Z                      rounding of forces, over C
//   Z^T K v = Z^T (P' - ... - F')    Z: left vectors with Z^T C = 0   rounding of rates of forces, over K
//
//   |d(f . v)| <= sum_j |x_j| sum_i |(Y, Z)_ij| noise_i,   S^T x = f,   S = (Y^T C, Z^T K)
//
// C and K on degrees of freedom without mass, with the dashpots and springs of closed contacts. A damper along an odd direction
// of a node, or the dashpot of a contact that slides, leaves one sum of the node's rows to K.
//
// A part that rests under forces of size F has velocities of rounding, eps F/C. They tell no direction of slip. Unit:
// that of f . v, length/time.
#pragma once

#include "witness/laws.hpp"

namespace signorini {

/// Of the slip rate of contact k in its state on this side. 0: it acts on mass; or the rows of its parts without mass do
/// not tell their velocities, where one sticks rigidly or dampers couple more than 300 of them.
[[nodiscard]] double noise_of_slip_rate(const Bench& bench, const WitnessedSide& side, std::size_t k);

}  // namespace signorini
