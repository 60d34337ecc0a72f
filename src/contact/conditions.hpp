// conditions.hpp: the amount by which a contact violates its own conditions.
//
//   (6)  g >= 0, N <= 0, g N = 0          g minus the element's length if there is a spring
//   (7)  |T| <= T_U, T p' >= 0            T_U static in stick, of the slip rate in slip
#pragma once

#include "contact/mode.hpp"

namespace signorini {

/// Each value is positive if its condition is violated.
struct Violations {
  double tension = 0.0;      ///< N; force
  double gap = 0.0;          ///< -(g - element); length, contacts with a spring
  double penetration = 0.0;  ///< |g| closed, -g open; length, constraints
  double product = 0.0;      ///< |g N|, g as above; energy
  double friction = 0.0;     ///< |T| - T_U, closed contacts; force
  double direction = 0.0;    ///< -T p', in slip; power
};

[[nodiscard]] Violations violations(const Contact& contact, State state, const ContactMotion& m);

}  // namespace signorini
