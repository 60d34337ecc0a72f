// standing.hpp: where a contact stands on a slow way, and how far it is from its limits.
//
//   f |N| - s T >= 0, s = +-1       while it sticks
//   touching: g = 0 and N = 0       neither pressed nor apart
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// Rates are along the stage, from 0 to 1.
struct Standing {
  State state = State::open;
  double gap = 0.0, N = 0.0, T = 0.0;
  double gap_rate = 0.0, N_rate = 0.0, T_rate = 0.0;
  double given_gap_rate = 0.0;    ///< of the gap without displacement, while a fit grows
  int normal = -1, tangent = -1;  ///< rows in force
};

/// Before anything is loaded.
[[nodiscard]] Standing undeformed(const Contact& contact);

/// Kinetic where it slips.
[[nodiscard]] double friction_of(const Contact& contact, const Standing& standing);
/// f |N| - s T
[[nodiscard]] double margin_of(const Contact& contact, const Standing& standing, int s);

/// Below this a force is zero, the greatest so far being so great.
[[nodiscard]] double zero_force(double greatest);
/// zero: a force; travelled: sum of the magnitudes that its gap is a difference of.
[[nodiscard]] bool touching(const Contact& contact, const Standing& standing, double zero, double travelled);

}  // namespace signorini
