// frictional.hpp: quasi-static loading with friction: loads are applied slowly, stage by stage, and the result depends
// on their order.
//
//   K u + sum_k ( n_k N_k + t_k T_k ) = P(l),    P(l) = P_before + l dP,   0 <= l <= 1
//   n . u - N / kn = -gap,   t . u - T / kt = p   on closed contacts; 1 / k = 0 on rigid ones
//
// For given contact states all quantities are linear in l, so a contact changes its state at the zero of a linear function.
// At a change, the rates along l determine the next states, with the opening rate x and the slip rate p' = a - b:
//
//   touching, N = 0        -N'           _|_ x >= 0
//                          -f N' -+ T'   _|_ a, b >= 0
//   at its limit, T = s f |N|    -f N' - s T'  _|_ s p' >= 0
//
// This is one linear complementarity problem of all contacts that touch or are at their limit
// (quasi_static_rates.hpp). If there is no solution, or if a motion has no stiffness, the continuation would be
// dynamic, and the start is refused. If several solutions are found, the smallest one is taken and reported.
//
// If closed contacts at their limits do not resist some motion, many slips are possible with the same forces. The
// smallest slips are taken (smallest_motion.hpp) and reported in StaticStart::undetermined.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/statics/quasi_static_rates.hpp"
#include "signorini/model.hpp"

namespace signorini::statics {

/// Loads of one stage; they grow linearly during the stage, in addition to the loads of earlier stages.
struct Stage {
  std::string name;
  Vector load;    ///< dP; one entry per degree of freedom
  int steps = 1;  ///< equal steps of the load factor; one StageEnd each
};

struct FrictionalEquilibrium {
  Vector u;                    ///< length n
  std::vector<double> shears;  ///< T of each contact
  StaticStart start;
  std::vector<LimitMargin> margins;  ///< one per contact
};

/// Applies the stages, from u = 0 without load. Errors: SceneError at `place` that names the stage, the
/// load factor reached, and the reason.
[[nodiscard]] FrictionalEquilibrium frictional_equilibrium(const SparseMatrix& stiffness,
                                                           const std::vector<Contact>& contacts,
                                                           const std::vector<Stage>& stages,
                                                           const assembly::DofMap& map,
                                                           const SourcePlace& place);

/// Applies one more stage, with another stiffness, to the result of earlier stages.
[[nodiscard]] FrictionalEquilibrium continue_loading(FrictionalEquilibrium from,
                                                     const SparseMatrix& stiffness,
                                                     const std::vector<Contact>& contacts, const Stage& stage,
                                                     const assembly::DofMap& map, const SourcePlace& place);

}  // namespace signorini::statics
