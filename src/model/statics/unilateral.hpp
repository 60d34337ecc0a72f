// unilateral.hpp: closed contacts in frictionless equilibrium.
//
//   minimise  u K u / 2 - P u + sum_k kn_k min(g_k(u), 0)^2 / 2 + (1e-12) u D u / 2,   D = diag of the matrix
//
// The last term only keeps every Newton matrix regular while contacts open and close.
#pragma once

#include <vector>

#include "model/statics/static_system.hpp"

namespace signorini {

/// closed[k] for every contact (false for sliders).
[[nodiscard]] std::vector<bool> closed_supports(const StaticProblem& problem);

}  // namespace signorini
