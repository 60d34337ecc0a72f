// driven_states.hpp: states determined by displacements, velocities and forcing alone: at the start, and where the
// forcing is not smooth.
//
//   slider       open iff its given compression is zero
//   compliant    at the start open iff g >= 0; slips if it slipped at the end of the run that is continued
//   stick        ends if the surface's velocity jumps away from t . v, unless there is a tangential stiffness
#pragma once

#include "contact/law.hpp"
#include "decide/instant.hpp"
#include "motion/forcing.hpp"

namespace signorini::decide {

/// Initial guess of the states from displacements and velocities at the start.
[[nodiscard]] contact::ContactStates initial_states(const Model& model, const motion::Forcing& forcing,
                                                    double t, const Vector& u, const Vector& v);

/// Guards of compliant contacts that are zero up to rounding at the start of a continued run. The previous
/// run ended in another state than the one in `states`, which follows from the position alone, and the guard
/// between both states is zero. Without these guards the last event of the previous run would occur again.
[[nodiscard]] std::vector<TriggeredGuard> guards_zero_at_start(const Model& model, const Vector& u,
                                                               const Vector& v,
                                                               const contact::ContactStates& states);

/// Lets slipping contacts on massless parts stick if ut jumps against their slip direction. ut may jump
/// there, so the slip of the instant is found as in statics. A contact continues to slip if its p moves along
/// the slip, from the motion `before` to the motion `after` in `states`. Otherwise it sticks at its last p,
/// and its guards decide about further slip. True: at least one more contact sticks.
[[nodiscard]] bool resolve_slip_reversal(const Model& model, const std::vector<ContactMotion>& before,
                                         const std::vector<MotionJet>& after, contact::ContactStates& states);

/// Changes `states` where the forcing is not smooth. motion: just before, one entry per contact.
void apply_forcing_jump(const Model& model, const Instant& instant, const motion::Forcing& before,
                        const motion::Forcing& after, const std::vector<ContactMotion>& motion,
                        contact::ContactStates& states);

}  // namespace signorini::decide
