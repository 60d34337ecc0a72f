// driven_states.hpp: states that follow from displacements, velocities and the forcing alone: at the start,
// and where the forcing is not smooth.
//
//   slider       open iff its compression is lifted
//   compliant    at the start open iff g >= 0; slips if the run that it goes on from did
//   stick        ends where the surface's velocity jumps away from t . v, unless an element lies between
#pragma once

#include "decide/instant.hpp"
#include "motion/forcing.hpp"

namespace signorini {

/// A first guess of the states from displacements and velocities at the start.
[[nodiscard]] Mode first_mode(const Model& model, const Forcing& forcing, double t, const Vector& u,
                              const Vector& v);

/// Changes the states in `mode` where the forcing is not smooth. motion: just before, one a contact.
void follow_forcing(const Model& model, const Instant& instant, const Forcing& before, const Forcing& after,
                    const std::vector<ContactMotion>& motion, Mode& mode);

}  // namespace signorini
