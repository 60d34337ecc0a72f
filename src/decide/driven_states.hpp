// driven_states.hpp: contact states that follow from displacements, velocities and forcing alone, at the start and where the
// forcing is not smooth.
//
//   slider       open iff its given compression is zero
//   compliant    at the start open iff g >= 0; slips if it slipped at the end of a continued run
//   stick        ends if the surface's velocity jumps and kt is absent
#pragma once

#include "contact/law.hpp"
#include "decide/instant.hpp"
#include "motion/forcing.hpp"

namespace signorini::decide {

/// Initial guess of the contact states, from displacements and velocities at the start.
[[nodiscard]] contact::ContactStates initial_states(const Model& model, const motion::Forcing& forcing,
                                                    double t, const Vector& u, const Vector& v);

/// Guards of compliant contacts that are zero up to rounding at the start of a continued run. Such a contact is in another
/// state at the end of the previous run than in `states`, which follows from the position alone, and the guard between both
/// states is zero. Without these guards the last event of the previous run would occur again.
[[nodiscard]] std::vector<TriggeredGuard> guards_zero_at_start(const Model& model, const Vector& u,
                                                               const Vector& v,
                                                               const contact::ContactStates& states);

/// Lets slipping contacts on massless parts stick if ut jumps against the slip direction. On massless parts ut may jump, so
/// the slip at this instant is found as in statics. A contact continues to slip if its p changes along the slip, from the
/// motion `before` to the motion `after` in `states`. Otherwise it sticks at its last p, and its guards decide about further
/// slip. True: at least one contact was changed to stick.
[[nodiscard]] bool resolve_slip_reversal(const Model& model, const std::vector<ContactMotion>& before,
                                         const std::vector<MotionJet>& after, contact::ContactStates& states);

/// Changes `states` where the forcing is not smooth. motion: the motion just before, one entry per contact.
void apply_forcing_jump(const Model& model, const Instant& instant, const motion::Forcing& before,
                        const motion::Forcing& after, const std::vector<ContactMotion>& motion,
                        contact::ContactStates& states);

}  // namespace signorini::decide
