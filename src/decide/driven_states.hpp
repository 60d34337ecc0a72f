// driven_states.hpp: states that follow from displacements, velocities and the forcing alone: at the start,
// and where the forcing is not smooth.
//
//   slider       open iff its compression is lifted
//   compliant    at the start open iff g >= 0; slips if the run that it goes on from did
//   stick        ends where the surface's velocity jumps away from t . v, unless an element lies between
#pragma once

#include "contact/transition.hpp"
#include "decide/instant.hpp"
#include "motion/forcing.hpp"

namespace signorini {

/// A first guess of the states from displacements and velocities at the start.
[[nodiscard]] Mode first_mode(const Model& model, const Forcing& forcing, double t, const Vector& u,
                              const Vector& v);

/// Guards of soft contacts that fell where the run ended that this one goes on from: it left the contact in another state
/// than `mode`, which the place alone tells, and the guard between the two is zero to rounding. Else it would fall again.
[[nodiscard]] std::vector<Fired> fell_at_start(const Model& model, const Vector& u, const Vector& v,
                                               const Mode& mode);

/// Where ut itself may jump, on parts without mass, the slip of that instant is found as in statics. What slips goes
/// on as long as p moves along its slip, from the motion before to that in `mode` after. What would go back sticks
/// where it was, elastic first; its limits decide the rest. True: one more sticks.
[[nodiscard]] bool turn_back(const Model& model, const std::vector<ContactMotion>& before,
                             const std::vector<MotionJet>& after, Mode& mode);

/// Changes the states in `mode` where the forcing is not smooth. motion: just before, one a contact.
void follow_forcing(const Model& model, const Instant& instant, const Forcing& before, const Forcing& after,
                    const std::vector<ContactMotion>& motion, Mode& mode);

}  // namespace signorini
