// frictional.hpp: a start that remembers how its loads came: slowly, one stage after the other, with
// friction.
//
//   K u + sum_k ( n_k N_k + t_k T_k ) = P(l),    P(l) = P_before + l dP,   0 <= l <= 1
//   n . u - N / kn = -gap,   t . u - T / kt = p   on closed contacts; 1 / k = 0 on rigid ones
//
// For given states all of it is linear in l, so that a change of state is found as the root of a line. Where
// one is due, the rates along l say how it goes on: with opening x, slip rate p' = a - b,
//
//   touching, N = 0        -N'           _|_ x >= 0
//                          -f N' -+ T'   _|_ a, b >= 0
//   at its limit, T = s f |N|    -f N' - s T'  _|_ s p' >= 0
//
// one linear complementarity problem of all contacts that touch or are at their limit (slow_rates.hpp). No solution,
// or no stiffness left: what would follow is a motion, and the start is refused. Several: one is taken, and said.
//
// Where closed contacts at their limits leave a motion that nothing resists, so that many slips go with the
// same forces, the least of them is taken (least_motion.hpp) and said in StaticStart::doubts.
#pragma once

#include <vector>

#include "model/assembly/dofs.hpp"
#include "model/statics/standing.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// What grows in a stage; its loads from what they were to what they are at its end.
struct Stage {
  std::string name;
  Vector load;  ///< dP; n
  int steps = 1;
};

struct FrictionalEquilibrium {
  Vector u;                    ///< n
  std::vector<double> shears;  ///< T a contact
  StaticStart start;
  std::vector<Standing> standing;  ///< one a contact
};

/// From u = 0 without load. Errors: SceneError at `place` that names the stage, how far it came, and what
/// nothing holds.
[[nodiscard]] FrictionalEquilibrium frictional_equilibrium(const SparseMatrix& stiffness,
                                                           const std::vector<Contact>& contacts,
                                                           const std::vector<Stage>& stages,
                                                           const DofMap& map, const SourcePlace& place);

/// One more stage from there, on another stiffness.
[[nodiscard]] FrictionalEquilibrium gone_on(FrictionalEquilibrium from, const SparseMatrix& stiffness,
                                            const std::vector<Contact>& contacts, const Stage& stage,
                                            const DofMap& map, const SourcePlace& place);

}  // namespace signorini
