// release.hpp: parts without mass that leave a contact at once.
//
//   |T| = f|N| in stick, and slip by a would change f|N| - |T| at the rate h' = h0' + c a:   h0' < 0,  c <= 0
//
// Then neither stick (h' = h0' < 0) nor slip (a = -h0'/c < 0) continues the motion: friction on parts without
// mass raises the pull by more than slip relieves it. No continuous motion exists. That of the same parts with a
// small mass does: the slip accelerates, since f|N| falls faster than the pull, until N = 0. The contact has let
// go, and the parts are where they are in equilibrium without it; the mass tends to zero, and all that takes no
// time. So it is where friction drops to its kinetic value, or data at the start, leave a force that would have
// to pull. What a dashpot holds cannot close meanwhile, so the gap must have opened by it.
#pragma once

#include <optional>

#include "decide/instant.hpp"
#include "motion/jet.hpp"

namespace signorini {

/// Some part that the contact acts on has no mass.
[[nodiscard]] bool carries_massless(const Model& model, const Contact& contact);

/// Displacements once contact c has let go and parts without mass have followed. `mode`: states of all others.
/// Nothing: it carries no part without mass, or its gap would not open.
[[nodiscard]] std::optional<Vector> released(ModeSystems& systems, JetMaker& jets, const Forcing& forcing,
                                             const Instant& instant, Mode mode, std::size_t c);

}  // namespace signorini
