// bowl.hpp: the restoring force of a curved surface.
//
//   F = ( |N| - N_K ) ut / R      against ut, besides N_K ut / R, which stands in K       (R: Bowl::radius)
//
// Small slopes: the normal turns by ut / R, and with it the force on the body. N_K is the force that the bearing
// carries at rest; where N stays that, nothing is left of F.
#pragma once

#include "signorini/contact.hpp"

namespace signorini {

/// F along the tangent; the force on the body is -F. 0 where the surface is not curved. Unit: force.
[[nodiscard]] inline double bowl_force(const Contact& contact, double N, double ut) {
  return contact.bowl ? (-N - contact.bowl->carried) / contact.bowl->radius * ut : 0.0;
}
/// A later term of its series, -N_i ut_j / R: the constant N_K counts in the first term alone, which is bowl_force.
[[nodiscard]] inline double bowl_product(const Contact& contact, double N, double ut) {
  return -N / contact.bowl->radius * ut;
}

/// ( N_K - N_0 ) / R: what K holds beside the spring N_0 / R of the scene, which says N_0; 0 where the surface is not curved.
[[nodiscard]] inline double beyond_spring(const ContactSpec& said, const Contact& contact) {
  return contact.bowl ? (contact.bowl->carried - said.bowl->carried) / contact.bowl->radius : 0.0;
}

}  // namespace signorini
