// driven_states.hpp: states determined by displacements, velocities and forcing alone: at the start, and where the
// forcing is not smooth.
//
//   slider       open iff its compression is lifted
//   compliant    at the start open iff g >= 0; slips if it slipped at the end of the run that is continued
//   stick        ends if the surface's velocity jumps away from t . v, unless there is an element between
#pragma once

#include "contact/law.hpp"
#include "decide/instant.hpp"
#include "motion/forcing.hpp"

namespace signorini::decide {

/// Initial guess of the states from displacements and velocities at the start.
[[nodiscard]] contact::ContactStates initial_states(const Model& model, const motion::Forcing& forcing,
                                                    double t, const Vector& u, const Vector& v);

/// Guards of compliant contacts that were zero at the end of the run that is continued: that run left the contact in
/// another state than in `states`, which follows from the position alone, and the guard between the two is zero up to
/// rounding. Without this the event would occur again.
[[nodiscard]] std::vector<TriggeredGuard> guards_zero_at_start(const Model& model, const Vector& u,
                                                               const Vector& v,
                                                               const contact::ContactStates& states);

/// Corrects slip where ut itself may jump, on massless parts: the slip of that instant is found as in statics. A
/// slipping contact continues if p moves along its slip, from the motion before to that in `states` after. Otherwise it
/// sticks where it was, elastic first; its limits decide the rest. True: one more contact sticks.
[[nodiscard]] bool resolve_slip_reversal(const Model& model, const std::vector<ContactMotion>& before,
                                         const std::vector<MotionJet>& after, contact::ContactStates& states);

/// Changes `states` where the forcing is not smooth. motion: just before, one entry per contact.
void apply_forcing_jump(const Model& model, const Instant& instant, const motion::Forcing& before,
                        const motion::Forcing& after, const std::vector<ContactMotion>& motion,
                        contact::ContactStates& states);

}  // namespace signorini::decide
