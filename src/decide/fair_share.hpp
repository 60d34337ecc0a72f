// fair_share.hpp: friction that several contacts share on one motion.
//
//   min sum k_i^2,   k = k0 + Z y,   |k_i| <= fs l_i        W Z = 0: Z moves nothing
//
// A complementarity problem yields some forces that hold a body; two of its feet, or sliders, that stick may share the
// friction in other ways. Taken is the share of the least norm, and where that leaves a cone the nearest one within: that contact
// is at its limit, the others bear the rest.
#pragma once

#include "decide/coulomb_problem.hpp"

namespace signorini {

/// Changes the friction of frictional items with a response of zero, where that changes no response.
void share_fairly(const CoulombProblem& problem, CoulombSolution& solution);

}  // namespace signorini
