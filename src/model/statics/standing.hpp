// standing.hpp: state of a contact during quasi-static loading, and its distance from the limits.
//
//   f |N| - s T >= 0, s = +-1       while it sticks
//   touching: g = 0 and N = 0       neither compressed nor separated
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// State of one contact; rates are along the stage, from 0 to 1.
struct Standing {
  State state = State::open;
  double gap = 0.0, N = 0.0, T = 0.0;
  double gap_rate = 0.0, N_rate = 0.0, T_rate = 0.0;
  double given_gap_rate = 0.0;    ///< rate of the given gap, without displacements, while an interference is
                                  ///< fitted
  int normal = -1, tangent = -1;  ///< rows in force
};

/// State before any load.
[[nodiscard]] Standing undeformed(const Contact& contact);

/// Friction coefficient: kinetic in slip, else static.
[[nodiscard]] double friction_of(const Contact& contact, const Standing& standing);
/// f |N| - s T
[[nodiscard]] double margin_of(const Contact& contact, const Standing& standing, int s);

/// Threshold below which a force is zero, for the largest force so far.
[[nodiscard]] double zero_force(double greatest);
/// zero: threshold of forces; travelled: sum of the magnitudes of the gap's terms.
[[nodiscard]] bool touching(const Contact& contact, const Standing& standing, double zero, double travelled);

}  // namespace signorini
