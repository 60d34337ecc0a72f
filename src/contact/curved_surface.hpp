// curved_surface.hpp: the restoring force of a curved surface, such as that of a friction pendulum.
//
//   F = ( |N| - N_K ) ut / R      acts against ut, in addition to N_K ut / R, which is part of K
//   R: CurvedSurface::radius,  N_K: CurvedSurface::nominal_force
//
// Slopes are assumed small: the normal, and with it the force on the body, rotates by the angle ut / R. N_K is the normal
// force of the bearing at rest; F is zero if |N| = N_K.
#pragma once

#include "signorini/contact.hpp"

namespace signorini::contact {

/// Restoring force F along the tangent; the force on the body is -F. Zero if the surface is not curved. Unit: force.
[[nodiscard]] inline double restoring_force(const Contact& contact, double N, double ut) {
  return contact.pendulum_surface
             ? (-N - contact.pendulum_surface->nominal_force) / contact.pendulum_surface->radius * ut
             : 0.0;
}
/// Product -N_i ut_j / R of two Taylor coefficients, for coefficients of F of order 1 and above. The constant N_K occurs only
/// in the coefficient of order 0, which is restoring_force().
[[nodiscard]] inline double restoring_product(const Contact& contact, double N, double ut) {
  return -N / contact.pendulum_surface->radius * ut;
}

/// Stiffness ( N_K - N_0 ) / R, which is added to K. K already contains the stiffness N_0 / R of the scene's spring; N_0: the
/// nominal force of `in_scene`. 0 if the surface is not curved.
[[nodiscard]] inline double extra_stiffness(const ContactSpec& in_scene, const Contact& contact) {
  return contact.pendulum_surface
             ? (contact.pendulum_surface->nominal_force - in_scene.pendulum_surface->nominal_force) /
                   contact.pendulum_surface->radius
             : 0.0;
}

}  // namespace signorini::contact
