// graze.hpp: guards and gaps that came so close to zero that the run cannot decide whether they reached it.
#pragma once

#include <string>

namespace signorini::events {

/// A guard that came back into its tolerance and left it without a zero crossing at any step. A run with a smaller tolerance
/// decides whether the guard reached zero.
struct Graze {
  double t = 0.0;
  int contact = -1;
  std::string guard;  ///< to_string(Guard): "compression", "slip rate"
};

/// Local minimum of the gap of an open contact. Near t, the gap at time t' is gap + half_curvature (t' - t)^2.
struct NearHit {
  double t = 0.0;
  int contact = -1;
  double gap = 0.0;  ///< >= 0
  double half_curvature = 0.0;
};

}  // namespace signorini::events
