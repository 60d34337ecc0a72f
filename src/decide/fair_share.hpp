// fair_share.hpp: forces of rigid contacts and sliders that accelerations leave open.
//
//   min sum ( l_i^2 + k_i^2 )   over   W f = W f_0,   (l_i, k_i) in the cone of contact i
//
//   it presses and rests    0 <= l,  |k| <= fs l        pressed by a given l:  |k| <= fs l
//   it presses and slips    0 <= l,  k = -f l sign(rt)
//   without friction        0 <= l
//
// A complementarity problem yields some forces that hold a body. Two of its feet that stick may share the friction in other
// ways, and with feet at unequal heights their compressions, too. The accelerations are those of all; the forces of least norm
// are unique, so that they depend neither on the order of contacts nor on the method that found the accelerations. A contact
// whose force of least norm lies on its cone is at its limit.
#pragma once

#include "decide/coulomb_problem.hpp"

namespace signorini {

/// Replaces the forces of items of which others may hold the same motion, `may_share`, where that changes no response.
void share_fairly(const CoulombProblem& problem, const std::vector<bool>& may_share,
                  CoulombSolution& solution);

}  // namespace signorini
