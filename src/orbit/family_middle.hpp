// family_middle.hpp: selects the orbit of a family that a branch follows.
//
//   m+ = min (f_s |N| - T),   m- = min (f_s |N| + T)      margins of a contact that never slips, over the period
//   z = z_0 + W a,   W: (Phi - I) W = 0                   the family
//   m+ = m-                                               its middle
//
// A contact that never slips may have any mean force between its limits. Members of the family with a zero margin
// graze: a step of the branch from there makes the contact slip once, the orbit settles at its limit again, and each
// point grazes. In the middle nothing grazes until both margins are zero, where the contact begins to slip in both
// directions.
//
// Margins are linear in a if all forces are; d(margins)/da is a difference of runs.
#pragma once

#include "orbit/branch_newton.hpp"

namespace signorini {

/// The orbit in the middle, with its multipliers along t. nullopt: `here` is in the middle or in no such family, or
/// Newton's method finds no better one.
[[nodiscard]] std::optional<Corrected> family_middle(const BranchMap& map, const BranchNewton& newton,
                                                     const Corrected& here, const Vector& t);

}  // namespace signorini
