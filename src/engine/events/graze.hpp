// graze.hpp: guards and gaps that came so close to zero that the run cannot decide whether they reached it.
#pragma once

#include <string>

namespace signorini::events {

/// A guard that decreased to within its tolerance of zero and rose again, without a zero crossing. Only a run with a smaller
/// tolerance can decide whether the guard reached zero.
struct Graze {
  double t = 0.0;
  int contact = -1;
  std::string guard;  ///< to_string(Guard): "compression", "slip rate"
};

/// Local minimum of the gap of an open contact, at time t. At a time t' near t, the gap is gap + half_curvature (t' - t)^2.
struct NearHit {
  double t = 0.0;
  int contact = -1;
  double gap = 0.0;  ///< >= 0
  double half_curvature = 0.0;
};

}  // namespace signorini::events
