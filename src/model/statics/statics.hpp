// statics.hpp: frictionless unilateral equilibrium, for initial = "static".
//
//   K u = P - sum_k n_k N_k,   N_k = kn_k min(g_k, 0),   g_k = g0_k + n_k . u
//
// the minimum of the convex, piecewise quadratic energy u K u / 2 - P u + sum kn min(g, 0)^2 / 2. Found
// by Newton's method with an exact line search, which cannot cycle, from all contacts closed.
//
// A null motion of K + sum_closed kn n n^T on which the loads do no work is free: it is held by ut = 0 at
// the first contact in file order that can. One that the loads drive is refused. Sliders carry nothing
// here, but can hold a free motion. A contact whose normal carries nothing is open where the structure does not
// reach it, whichever way rounding turns its reaction.
//
// With geometric stiffness (run.geometric) K may have negative energy where contacts are open, and Newton's method has
// no minimum to find. So it begins with the contacts that are closed without it.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

namespace signorini {

struct Equilibrium {
  Vector u;                  ///< n
  StaticStart start;         ///< reactions -N >= 0 a contact, names of free motions
  std::vector<bool> closed;  ///< one a contact
};

struct EquilibriumSearch {
  const char* key = "run.initial";  ///< in messages
  bool mechanisms = false;          ///< what nothing holds may stay, if nothing drives it
  /// One a contact: begins with these, and K need not be semidefinite without them.
  std::optional<std::vector<bool>> closed = {};
};

/// Errors: SceneError at `place` that names what nothing holds, what is driven, and what would pull.
[[nodiscard]] Equilibrium find_equilibrium(const SparseMatrix& stiffness, const Vector& load,
                                           const std::vector<Contact>& contacts, const DofMap& map,
                                           const SourcePlace& place, const Units& units,
                                           const EquilibriumSearch& search = {});

}  // namespace signorini
