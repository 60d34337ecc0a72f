// graze.hpp: what an engine leaves open: a guard that came back into its tolerance and left it without a zero crossing
// that its steps could show. A run with a smaller tolerance decides whether it reached zero.
#pragma once

#include <string>

namespace signorini::events {

struct Graze {
  double t = 0.0;
  int contact = -1;
  std::string guard;  ///< to_string(Guard): "compression", "slip rate"
};

/// A least gap of an open contact: around t it is gap + bend (t' - t)^2.
struct NearHit {
  double t = 0.0;
  int contact = -1;
  double gap = 0.0;  ///< >= 0
  double half_curvature = 0.0;
};

}  // namespace signorini::events
