// driven_states.hpp: contact states that follow from displacements, velocities and forcing alone: at the start, and at times at
// which the forcing is not smooth.
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

/// Guards of compliant contacts that are zero up to rounding at the start of a continued run. The state of such a contact in
/// `states` differs from its state at the end of the previous run, because `states` follows from displacements alone. Without
/// these guards the last event of the previous run would occur again.
[[nodiscard]] std::vector<TriggeredGuard> guards_zero_at_start(const Model& model, const Vector& u,
                                                               const Vector& v,
                                                               const contact::ContactStates& states);

/// Changes slipping contacts on massless parts to stick if p jumps against the slip direction from the motion `before` to the
/// motion `after`, which is computed with `states`. Such a contact sticks at its previous p, and its guards then decide about
/// further slip. ut may jump because the parts have no mass. True: at least one contact was changed to stick.
[[nodiscard]] bool resolve_slip_reversal(const Model& model, const std::vector<ContactMotion>& before,
                                         const std::vector<MotionJet>& after, contact::ContactStates& states);

/// Changes `states` at an instant at which the forcing is not smooth. motion: motion of each contact just before the instant.
void apply_forcing_jump(const Model& model, const Instant& instant, const motion::Forcing& before,
                        const motion::Forcing& after, const std::vector<ContactMotion>& motion,
                        contact::ContactStates& states);

}  // namespace signorini::decide
