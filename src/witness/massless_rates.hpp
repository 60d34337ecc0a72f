// massless_rates.hpp: how far rounding moves the velocities of parts without mass.
//
//   C v = P - K u - F      in rows that a damper or a dashpot acts on:  rounding of forces, over C
//   K v = P' - ... - F'    in the others:                               rounding of rates of forces, over K
//
//   |d(f . v)| <= sum_i |x_i| noise_i,   S^T x = f,   S: these rows of C and of K, with the springs of closed contacts
//
// A part that rests under forces of size F has velocities of rounding, eps F/C. They tell no direction of slip. Unit:
// that of f . v, length/time.
#pragma once

#include "witness/laws.hpp"

namespace signorini {

/// Of the slip rate of contact k in its state on this side. 0: it acts on mass; or the rows of its parts without mass do
/// not tell their velocities, where one sticks rigidly or dampers act along some directions of a node only.
[[nodiscard]] double noise_of_slip_rate(const Bench& bench, const WitnessedSide& side, std::size_t k);

}  // namespace signorini
