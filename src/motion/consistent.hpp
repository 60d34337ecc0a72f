// consistent.hpp: what follows from u and v at one instant in a mode.
//
//   M a + C v + K u + sum ( n N + t T ) = P,   rows of the mode     for a, N, T and v of massless parts
//
// Without mass the equation itself yields u (or v, where it is damped), its derivative v (a), its second
// derivative a.
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

  /// Puts all accelerations that u and v ask for into the point, those without mass among them; u, v and forces
  /// stay.
  void accelerate(const ModeSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 2 : 0, 1.0, series_);
    point.a = 2.0 * series_.u.col(2);
  }

  /// make() leaves accelerations without mass at zero.
  [[nodiscard]] bool massless() const { return taylor_.massless(); }

 private:
  Taylor taylor_;
  Series series_;
};

}  // namespace signorini
