// restricted.hpp: what of a model lives on some of its degrees of freedom.
//
//   M_WW, C_WW, K_WW,   n_k, t_k of contacts on W alone,   P_W
//
// What couples W to the rest is left out: nothing for parts that nothing couples (part_models.hpp), the boundary of a
// neighbourhood (motion/near_jets.hpp).
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// On `dofs`, with `contacts`, which act on these alone: what runs of a model need; no outputs, no names but its own, nothing
/// drawn. Without loads.
[[nodiscard]] Model restricted(const Model& model, const std::vector<int>& dofs,
                               const std::vector<std::size_t>& contacts);
/// The same load, acting nowhere yet.
[[nodiscard]] Load without_direction(const Load& load);

}  // namespace signorini
