// statics.hpp: frictionless unilateral static equilibrium, for initial = "static".
//
//   K u = P - sum_k n_k N_k,   N_k = kn_k min(g_k, 0),   g_k = g0_k + n_k . u
//
// The solution is the minimum of the convex, piecewise quadratic energy
//
//   u K u / 2 - P u + sum kn min(g, 0)^2 / 2.
//
// This minimum is found by Newton's method with an exact line search, which cannot cycle, starting with all contacts
// closed.
//
// A null motion of K + sum_closed kn n n^T on which the loads do no work is free, and the contacts share it
// (free_motions.hpp). A null motion on which the loads do work is refused. Sliders have no force here, but can hold a
// free motion. A contact whose reaction is zero up to rounding is open, unless its gap would then be negative.
//
// With geometric stiffness (run.geometric) K may have negative energy while contacts are open, so that the energy has
// no minimum. Newton's method then starts with the contacts that are closed without geometric stiffness.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/statics/static_system.hpp"
#include "signorini/model.hpp"

namespace signorini::statics {

struct Equilibrium {
  Vector u;                  ///< length n
  StaticStart start;         ///< reactions -N >= 0 of each contact, names of free motions
  std::vector<bool> closed;  ///< one per contact
};

struct EquilibriumSearch {
  const char* key = "run.initial";  ///< key for messages
  bool mechanisms = false;          ///< true: mechanisms are allowed if no load does work on them
  /// Initial guess of the closed contacts, one entry per contact; K need not be semidefinite without them.
  std::optional<std::vector<bool>> closed = {};
};

/// Returns the equilibrium under a load. Errors: SceneError at `place` if there is none; the message names mechanisms,
/// motions on which the loads do work, or contacts that would be in tension.
[[nodiscard]] Equilibrium find_equilibrium(const SparseMatrix& stiffness, const Vector& load,
                                           const std::vector<Contact>& contacts, const assembly::DofMap& map,
                                           const SourcePlace& place, const Units& units,
                                           const EquilibriumSearch& search = {});

// Closed contacts in frictionless equilibrium.
//
//   minimise  u K u / 2 - P u + sum_k kn_k min(g_k(u), 0)^2 / 2 + (1e-12) u D u / 2,   D = diag of the matrix
//
// The last term only keeps every Newton matrix regular while contacts open and close.

/// Returns one entry per contact: true if it is closed in the equilibrium; false for sliders.
[[nodiscard]] std::vector<bool> closed_supports(const StaticProblem& problem);

}  // namespace signorini::statics
