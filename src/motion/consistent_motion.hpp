// consistent_motion.hpp: forces and accelerations that follow from u and v at one instant in a contact state.
//
//   M a + C v + K u + sum ( n N + t T ) = P,   rows of the state     for a, N, T and v of massless parts
//
// For massless degrees of freedom without damping the equation itself yields u, its first derivative v and
// its second derivative a. For damped ones it yields v, and its first derivative a.
#pragma once

#include "motion/taylor.hpp"

namespace signorini::motion {

class ConsistentMotion {
 public:
  explicit ConsistentMotion(StateSystems& systems) : taylor_(systems) {}

  /// Computes forces, accelerations and v of massless degrees of freedom that are consistent with u and v.
  void make(const StateSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 1 : 0, 1.0, series_);
    point = {series_.u.col(0), series_.u.col(1), series_.forces.col(0), 2.0 * series_.u.col(2)};
  }

  /// Writes all accelerations that are consistent with u and v into the point, including massless degrees of freedom;
  /// u, v and forces remain unchanged.
  void accelerate(const StateSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 2 : 0, 1.0, series_);
    point.a = 2.0 * series_.u.col(2);
  }

  /// True if there are massless degrees of freedom, whose accelerations make() leaves at zero.
  [[nodiscard]] bool massless() const { return taylor_.massless(); }

 private:
  Taylor taylor_;
  Series series_;
};

}  // namespace signorini::motion
