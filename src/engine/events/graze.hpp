// graze.hpp: guards and gaps that came so close to zero that the run cannot decide whether they reached it.
#pragma once

#include <string>

namespace signorini::events {

/// A guard that returned into its tolerance and left it without a zero crossing in the steps. A run with a
/// smaller tolerance decides whether it reached zero.
struct Graze {
  double t = 0.0;
  int contact = -1;
  std::string guard;  ///< to_string(Guard): "compression", "slip rate"
};

/// A local minimum of an open contact's gap, which is gap + half_curvature (t' - t)^2 at a time t' near t.
struct NearHit {
  double t = 0.0;
  int contact = -1;
  double gap = 0.0;  ///< >= 0
  double half_curvature = 0.0;
};

}  // namespace signorini::events
