// unknowns.hpp: indices in the vector of unknowns and in the vector of rows.
//
//   (x_1 ... x_n,  N_1, T_1,  N_2, T_2, ...)      forces in the order of signorini/force_layout.hpp
#pragma once

#include <vector>

#include "contact/law.hpp"
#include "linear/system_matrices.hpp"
#include "signorini/force_layout.hpp"
#include "signorini/model.hpp"

namespace signorini::linear {

struct Unknowns {
  std::size_t dofs = 0;
  ForceLayout layout = {};

  /// Index of N of a contact, which is also the index of its normal row.
  [[nodiscard]] std::size_t normal(std::size_t contact) const { return dofs + layout.normal(contact); }
  /// Index of T of a contact, which is also the index of its tangent row.
  [[nodiscard]] std::size_t tangent(std::size_t contact) const { return dofs + layout.tangent(contact); }
  [[nodiscard]] std::size_t size() const { return dofs + layout.size(); }
};

// Kinds of the unknown in the equation of a degree of freedom.
//
//   massive    with mass: its acceleration
//   damped     without mass, with a damper: its velocity
//   algebraic  without mass and damper: its displacement

enum class DofKind : unsigned char { massive, damped, algebraic };

/// Kinds from the structure alone; for the kinds in a contact state see linear/undamped_motion.hpp.
[[nodiscard]] std::vector<DofKind> dof_kinds(const Model& model, const SystemMatrices& structure);
/// True if some degree of freedom has no mass.
[[nodiscard]] bool has_massless(const Model& model);

// Restriction of a model to some of its degrees of freedom, W.
//
//   M_WW, C_WW, K_WW,   n_k, t_k of contacts on W alone,   P_W
//
// The coupling of W to the other degrees of freedom is omitted. It is zero for independent parts (model/assembly/parts.hpp).
// For a neighbourhood (motion/local_derivatives.hpp) the caller adds the forces of the coupling at the boundary.

/// Model on `dofs` with `contacts`, which act only on these degrees of freedom. It has the data that a run needs, but no
/// outputs, drawing or loads.
[[nodiscard]] Model restricted(const Model& model, const std::vector<int>& dofs,
                               const std::vector<std::size_t>& contacts);
/// Copy of a load with an empty direction: it acts on no degree of freedom.
[[nodiscard]] Load without_direction(const Load& load);

}  // namespace signorini::linear
