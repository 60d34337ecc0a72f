// loads.hpp: what acts on the structure as forms on its degrees of freedom, times functions of time.
//
//   P(t) = sum_i d_i f_i(t)
//
//   force, moment    on the node's own degrees of freedom
//   distributed      q on an element of length L, in its axes:  q_x L/2, q_y L/2, +- q_y L^2/12 at its ends
//   strain           EA (alpha T + strain) (-e, e), e along the element
//   weight, base     M r g, -M r a(t)
//   support s(t)     -K_fs (s + beta s') - M_fs (s'' + alpha s') - D_fs s',   C = D + alpha M + beta K
#pragma once

#include <vector>

#include "model/assembly/assembly.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Gravity first (when it acts), then the loads in the order of the file, strains of members, the motion of
/// the base, supports that move (without Rayleigh damping). Errors: SceneError.
[[nodiscard]] std::vector<Load> make_loads(const Scene& scene, const DofMap& map, const Assembly& assembly);

/// Those of the supports, with Rayleigh damping. Errors: SceneError for a motion that jumps or has a kink
/// where dampers or masses would answer with an impulse.
[[nodiscard]] std::vector<Load> support_loads(const Scene& scene, const DofMap& map, const Assembly& assembly,
                                              double alpha, double beta);

/// Sum of the static loads; n.
[[nodiscard]] Vector static_load(const std::vector<Load>& loads, int n);

}  // namespace signorini
