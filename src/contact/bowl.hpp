// bowl.hpp: the restoring force of a curved surface.
//
//   F = ( |N| - N_K ) ut / R      against ut, besides N_K ut / R, which stands in K       (R: Bowl::radius)
//
// Small slopes: the normal turns by ut / R, and with it the force on the body. N_K is the force that the bearing
// carries at rest; where N stays that, nothing is left of F.
#pragma once

#include "signorini/contact.hpp"

namespace signorini {

/// F along the tangent; the force on the body is -F. Contacts with a bowl. Unit: force.
[[nodiscard]] inline double bowl_force(const Contact& contact, double N, double ut) {
  return (-N - contact.bowl->carried) / contact.bowl->radius * ut;
}

/// ( N_K - N_0 ) / R: what K holds beside the spring N_0 / R of the scene, which says N_0.
[[nodiscard]] inline double beyond_spring(const Bowl& said, const Bowl& bowl) {
  return (bowl.carried - said.carried) / bowl.radius;
}

}  // namespace signorini
