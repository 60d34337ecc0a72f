// consistent.hpp: what follows from u and v at one instant in a mode.
//
//   M a + C v + K u + sum ( n N + t T ) = P,   rows of the mode     for a, N, T and v of massless parts
#pragma once

#include "motion/taylor.hpp"

namespace signorini {

class ConsistentMotion {
 public:
  explicit ConsistentMotion(ModeSystems& systems) : taylor_(systems) {}

  /// Makes forces, accelerations and v of massless degrees of freedom those that u and v ask for.
  void make(const ModeSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 1 : 0, 1.0, series_);
    point = {series_.u.col(0), series_.u.col(1), series_.forces.col(0), 2.0 * series_.u.col(2)};
  }

 private:
  Taylor taylor_;
  Series series_;
};

}  // namespace signorini
