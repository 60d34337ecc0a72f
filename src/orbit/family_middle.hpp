// family_middle.hpp: of a family of orbits the one that a branch follows.
//
//   m+ = min (f_s |N| - T),   m- = min (f_s |N| + T)      margins of a contact that never slips, over the period
//   z = z_0 + W a,   W: (Phi - I) W = 0                   the family
//   m+ = m-                                               its middle
//
// A contact that never slips may hold any mean force between its limits. Members of the family in which one margin is zero graze:
// a step of the branch from there makes the contact slip once, and the orbit settles at its limit again, so that each point
// grazes. In the middle nothing does until both margins are zero, where the contact begins to slip to both sides.
//
// Margins are linear in a where all forces are; d(margins)/da is a difference of runs.
#pragma once

#include "orbit/branch_newton.hpp"

namespace signorini {

/// The orbit in the middle, with its multipliers along t. Nothing: `here` is in the middle or of no such family, or Newton's
/// method finds none that is nearer to it.
[[nodiscard]] std::optional<Corrected> family_middle(const BranchMap& map, const BranchNewton& newton,
                                                     const Corrected& here, const Vector& t);

}  // namespace signorini
