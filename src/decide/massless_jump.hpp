// massless_jump.hpp: massless parts that move instantaneously while states are decided: their first touch, and where they
// stop.
//
//   u(x) = (1 - x) u_from + x u_to,   0 <= x <= 1:   a gap closes at (1 - x) g_from + x g_to = 0
//
// No time passes on such a way. The states of contacts that it passes are determined by the position on it.
#pragma once

#include <optional>
#include <vector>

#include "decide/guard_signs.hpp"
#include "decide/instant.hpp"
#include "motion/jet.hpp"
#include "signorini/model.hpp"

namespace signorini::decide {

struct MasslessPath {
  const Vector &from, &to;
};

/// A contact that is touched on the way.
struct PathTouch {
  std::size_t contact;
  double fraction;  ///< x
  double ut;        ///< its ut at this position, relative to the end of the way
};

/// Contact that the way closes first. Removes from `failed` the contacts that it closes later: after the first touch
/// the way is a different one. nullopt: the way closes no contact.
[[nodiscard]] std::optional<PathTouch> first_touch(const Model& model, const MasslessPath& way,
                                                   std::vector<FailedGuard>& failed);

/// If another contact of massless parts fails in the value of a guard, these parts are still on their way to the
/// equilibrium of the tried states. Their slip rates are known only at its end, so failures of slip rates are removed
/// from `failed`.
void defer_slip_failures(const Model& model, std::vector<FailedGuard>& failed);

/// True if friction has let a massless part go, and the part has slid instantaneously along its slip and stops at the
/// end of the way, where the dashpot beside it holds it. noise: of its ut.
[[nodiscard]] bool stops_on_path(const Contact& contact, const FailedGuard& failure, State slip,
                                 const MasslessPath& way, double noise);

// Massless parts that leave a contact instantaneously.
//
//   |T| = f|N| in stick, and slip by a would change f|N| - |T| at the rate h' = h0' + c a:   h0' < 0,  c <= 0
//
// Then neither stick (h' = h0' < 0) nor slip (a = -h0'/c < 0) continues the motion: friction on massless parts
// increases the pull by more than slip reduces it. No continuous motion exists. The same parts with a small mass have
// one: the slip accelerates, since f|N| decreases faster than the pull, until N = 0. The contact has let go, and the
// parts move to their equilibrium without it; as the mass tends to zero, this takes no time. The same happens if
// friction drops to its kinetic value, or if data at the start leave a tensile force. A contact with a dashpot cannot
// close meanwhile, so its gap must have opened by the jump.

/// True if the contact acts on a massless part.
[[nodiscard]] bool acts_on_massless(const Model& model, const Contact& contact);

/// Displacements after contact c has let go and massless parts have followed. `states`: of all other contacts.
/// nullopt: the contact acts on no massless part, or its gap would not open.
[[nodiscard]] std::optional<Vector> released(motion::StateSystems& systems, motion::JetMaker& jets,
                                             const motion::Forcing& forcing, const Instant& instant,
                                             contact::ContactStates states, std::size_t c);

}  // namespace signorini::decide
