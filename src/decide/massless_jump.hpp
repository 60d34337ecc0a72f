// massless_jump.hpp: massless parts that move instantaneously during a decision: the first contacts that close on the path of
// these parts, and the end of the path.
//
//   u(x) = (1 - x) u_from + x u_to,   0 <= x <= 1:   a gap closes at (1 - x) g_from + x g_to = 0
//
// No time passes on such a path. Contacts that close on the path are ordered by the position x at which they close. Contacts
// that close at one position, such as two halves of a contact, close together and stick there: one of them alone would
// lead the path elsewhere, and the others would close at another place.
#pragma once

#include <optional>
#include <vector>

#include "decide/guard_signs.hpp"
#include "decide/instant.hpp"
#include "motion/jet.hpp"
#include "signorini/model.hpp"

namespace signorini::decide {

/// Displacements at the beginning and at the end of an instantaneous motion of massless parts.
struct MasslessPath {
  const Vector &from, &to;
};

/// The first contacts that close on the path.
struct PathTouch {
  double fraction;  ///< position x at which they close
  struct Landing {
    std::size_t contact;
    double ut;  ///< ut at the position x minus ut at the end of the path
  };
  std::vector<Landing> landings;

  /// nullptr: the contact is not one of them.
  [[nodiscard]] const Landing* of(std::size_t contact) const;
};

/// Returns the first contacts that close on the path. Removes from `failed` the contacts that close later, because the path
/// changes at the first contacts. nullopt: no contact closes.
[[nodiscard]] std::optional<PathTouch> first_touch(const Model& model, const MasslessPath& way,
                                                   std::vector<FailedGuard>& failed);

/// If another guard of a contact on massless parts is negative in value, removes guards of slip rates on massless parts from
/// `failed`: the parts have not reached their equilibrium yet, and slip rates are known only in equilibrium.
void defer_slip_failures(const Model& model, std::vector<FailedGuard>& failed);

/// True if the guard of the slip rate fails, and the contact has moved on the path in its slip direction: it stops at the end
/// of the path. slip: state of the contact; noise: noise of ut.
[[nodiscard]] bool stops_on_path(const Contact& contact, const FailedGuard& failure, State slip,
                                 const MasslessPath& way, double noise);

// Massless parts that leave a contact instantaneously.
//
//   |T| = f|N| in stick, h = f|N| - |T|;   with the slip rate a:  h' = h0' + c a,   h0' < 0,  c <= 0
//
// If h0' < 0 and c <= 0, neither stick (h' = h0' < 0) nor slip (a = -h0'/c < 0) is possible, because slip reduces f|N| more
// than |T|. No continuous motion exists. With a small mass, the slip would accelerate until N = 0, the contact would open, and
// the parts would move to their equilibrium without the contact. In the limit of zero mass this motion takes no time. The jump
// also occurs if friction drops to its kinetic value, or if the data at the start require a tensile force. The jump must open
// the gap.

/// True if the normal or the tangent of the contact moves a massless degree of freedom.
[[nodiscard]] bool acts_on_massless(const Model& model, const Contact& contact);

/// Displacements after contact c has opened and massless parts have moved to equilibrium. states: states of all other
/// contacts. nullopt: the contact does not act on massless parts, or its gap would not open.
[[nodiscard]] std::optional<Vector> released(motion::StateSystems& systems, motion::JetMaker& jets,
                                             const motion::Forcing& forcing, const Instant& instant,
                                             contact::ContactStates states, std::size_t c);

}  // namespace signorini::decide
