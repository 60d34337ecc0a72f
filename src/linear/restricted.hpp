// restricted.hpp: restriction of a model to some of its degrees of freedom.
//
//   M_WW, C_WW, K_WW,   n_k, t_k of contacts on W alone,   P_W
//
// The coupling of W to the rest is left out: it is zero for independent parts (part_models.hpp); otherwise it acts at
// the boundary of a neighbourhood (motion/near_jets.hpp).
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// Model on `dofs` with `contacts`, which act on these alone: the data that runs of a model need; no outputs, no names
/// but its own, no drawing, no loads.
[[nodiscard]] Model restricted(const Model& model, const std::vector<int>& dofs,
                               const std::vector<std::size_t>& contacts);
/// The same load without a direction: it acts on no degree of freedom yet.
[[nodiscard]] Load without_direction(const Load& load);

}  // namespace signorini
