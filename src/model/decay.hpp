// decay.hpp: decay rates of motions, without computing a mode.
//
//   by damping alpha M + beta K   alpha + beta omega^2 at the frequency omega, with the damping ratio
//                                 (alpha / omega + beta omega) / 2
//   by the diagonals              C_ii / M_ii, and K_ii / C_ii where there is no mass
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// The largest rate given by the diagonals of M, C and K. Unit: 1/time.
[[nodiscard]] double diagonal_decay(const Vector& mass, const Vector& damping, const Vector& stiffness);

/// The fastest decay, 1/time: from the damping alpha M + beta K at omega_max, or from the diagonals, dashpots and
/// springs of contacts included.
[[nodiscard]] double fastest_decay(const Model& model);

/// Smallest damping ratio of any frequency up to omega_max, in any contact state (contact springs are not part of the
/// damping beta K); 0 if unknown.
[[nodiscard]] double least_damping_ratio(const Model& model);

}  // namespace signorini
