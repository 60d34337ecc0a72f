// release.hpp: massless parts that leave a contact instantaneously.
//
//   |T| = f|N| in stick, and slip by a would change f|N| - |T| at the rate h' = h0' + c a:   h0' < 0,  c <= 0
//
// Then neither stick (h' = h0' < 0) nor slip (a = -h0'/c < 0) continues the motion: friction on massless parts
// increases the pull by more than slip reduces it. No continuous motion exists. The same parts with a small mass have
// one: the slip accelerates, since f|N| decreases faster than the pull, until N = 0. The contact has let go, and the
// parts move to their equilibrium without it; as the mass tends to zero, this takes no time. The same happens if
// friction drops to its kinetic value, or if data at the start leave a tensile force. A contact with a dashpot cannot
// close meanwhile, so its gap must have opened by the jump.
#pragma once

#include <optional>

#include "decide/instant.hpp"
#include "motion/jet.hpp"

namespace signorini {

/// True if the contact acts on a massless part.
[[nodiscard]] bool carries_massless(const Model& model, const Contact& contact);

/// Displacements after contact c has let go and massless parts have followed. `mode`: states of all other contacts.
/// nullopt: the contact acts on no massless part, or its gap would not open.
[[nodiscard]] std::optional<Vector> released(ModeSystems& systems, JetMaker& jets, const Forcing& forcing,
                                             const Instant& instant, Mode mode, std::size_t c);

}  // namespace signorini
