// unknowns.hpp: places in a vector of unknowns, and in one of rows.
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

  /// N of a contact, and its normal row.
  [[nodiscard]] std::size_t normal(std::size_t contact) const { return dofs + layout.normal(contact); }
  /// T of a contact, and its tangent row.
  [[nodiscard]] std::size_t tangent(std::size_t contact) const { return dofs + layout.tangent(contact); }
  [[nodiscard]] std::size_t size() const { return dofs + layout.size(); }
};

// The unknown in the equation of a degree of freedom.
//
//   massive    with mass: its acceleration
//   damped     without mass, with a damper: its velocity
//   algebraic  with neither: its displacement

enum class DofKind : unsigned char { massive, damped, algebraic };

/// Kinds by the structure alone; in a contact state: linear/undamped_motion.hpp.
[[nodiscard]] std::vector<DofKind> dof_kinds(const Model& model, const SystemMatrices& structure);
/// True if there is a degree of freedom without mass.
[[nodiscard]] bool has_massless(const Model& model);

// Restriction of a model to some of its degrees of freedom.
//
//   M_WW, C_WW, K_WW,   n_k, t_k of contacts on W alone,   P_W
//
// The coupling of W to the rest is left out. It is zero for independent parts (model/assembly/parts.hpp);
// otherwise it acts at the boundary of a neighbourhood (motion/local_derivatives.hpp).

/// Model on `dofs` with `contacts`, which act on these alone. It has the data that a run needs, without
/// outputs, drawing and loads.
[[nodiscard]] Model restricted(const Model& model, const std::vector<int>& dofs,
                               const std::vector<std::size_t>& contacts);
/// Copy of a load with an empty direction: it acts on no degree of freedom.
[[nodiscard]] Load without_direction(const Load& load);

}  // namespace signorini::linear
