// decay.hpp: how fast motions die out, without computing a mode.
//
//   by damping alpha M + beta K   alpha + beta omega^2 at the frequency omega, with the damping ratio
//                                 (alpha / omega + beta omega) / 2
//   by the diagonals              C_ii / M_ii, and K_ii / C_ii where there is no mass
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The greatest of what the diagonals of M, C and K say. Unit: 1/time.
[[nodiscard]] double diagonal_decay(const Vector& mass, const Vector& damping, const Vector& stiffness);

/// The fastest decay, 1/time: of damping alpha M + beta K at omega_max, or what the diagonals say, dashpots
/// and springs of contacts included.
[[nodiscard]] double fastest_decay(const Model& model);

/// Least damping ratio of any frequency up to omega_max, whatever the states of the contacts, whose springs
/// have no part in the damping beta K; 0 where it is not known.
[[nodiscard]] double least_damping_ratio(const Model& model);

}  // namespace signorini
