// dof_kinds.hpp: what the equation of a degree of freedom is solved for.
//
//   massive    its acceleration
//   damped     its velocity: no mass, but a damper
//   algebraic  its displacement: neither
#pragma once

#include <vector>

#include "contact/law.hpp"
#include "linear/structure.hpp"

namespace signorini {

enum class DofKind : unsigned char { massive, damped, algebraic };

/// By the structure alone; in a mode: linear/undamped_motion.hpp.
[[nodiscard]] std::vector<DofKind> dof_kinds(const Model& model, const Structure& structure);
/// Is there a degree of freedom without mass?
[[nodiscard]] bool has_massless(const Model& model);

}  // namespace signorini
