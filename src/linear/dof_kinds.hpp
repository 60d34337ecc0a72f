// dof_kinds.hpp: the unknown in the equation of a degree of freedom.
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

/// Kinds by the structure alone; in a contact state: linear/undamped_motion.hpp.
[[nodiscard]] std::vector<DofKind> dof_kinds(const Model& model, const Structure& structure);
/// True if there is a degree of freedom without mass.
[[nodiscard]] bool has_massless(const Model& model);

}  // namespace signorini
