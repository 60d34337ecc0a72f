// massless_jump.hpp: massless parts that move instantaneously while states are decided: their first contact
// on the path, and their end position.
//
//   u(x) = (1 - x) u_from + x u_to,   0 <= x <= 1:   a gap closes at (1 - x) g_from + x g_to = 0
//
// No time passes on such a path. Contacts that close on it are decided by their positions x.
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

/// A contact that closes on the path.
struct PathTouch {
  std::size_t contact;
  double fraction;  ///< x
  double ut;        ///< ut there minus ut at the end of the path
};

/// The first contact that closes on the path. Removes from `failed` the contacts that close later, because
/// the path changes at the first one. nullopt: no contact closes.
[[nodiscard]] std::optional<PathTouch> first_touch(const Model& model, const MasslessPath& way,
                                                   std::vector<FailedGuard>& failed);

/// Removes failures of slip rates on massless parts from `failed`, if another guard there fails in value. The
/// parts have then not yet reached the equilibrium of the tried states, and their slip rates are known only
/// there.
void defer_slip_failures(const Model& model, std::vector<FailedGuard>& failed);

/// True if a contact whose slip rate fails has slid instantaneously along its slip, and its dashpot stops it
/// at the end of the path. noise: of its ut.
[[nodiscard]] bool stops_on_path(const Contact& contact, const FailedGuard& failure, State slip,
                                 const MasslessPath& way, double noise);

// Massless parts that leave a contact instantaneously.
//
//   |T| = f|N| in stick, and slip by a would change f|N| - |T| at the rate h' = h0' + c a:   h0' < 0,  c <= 0
//
// Then neither stick (h' = h0' < 0) nor slip (a = -h0'/c < 0) continues the motion: slip reduces f|N| more
// than |T|. No continuous motion exists. With a small mass the parts have a motion: the slip accelerates
// until N = 0, the contact opens, and the parts move to their equilibrium without it. As the mass tends to
// zero, this takes no time. The same happens if friction drops to its kinetic value, or if the data at the
// start require a tensile force. A contact with a dashpot cannot close meanwhile, so the jump must open its
// gap.

/// True if the contact acts on a massless part.
[[nodiscard]] bool acts_on_massless(const Model& model, const Contact& contact);

/// Displacements after contact c has opened and massless parts have moved to equilibrium. `states`: of all
/// other contacts. nullopt: the contact acts on no massless part, or its gap would not open.
[[nodiscard]] std::optional<Vector> released(motion::StateSystems& systems, motion::JetMaker& jets,
                                             const motion::Forcing& forcing, const Instant& instant,
                                             contact::ContactStates states, std::size_t c);

}  // namespace signorini::decide
