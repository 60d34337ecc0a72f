// consistent_motion.hpp: forces and accelerations that are consistent with u and v at one instant in a contact state.
//
//   M a + C v + K u + sum ( n N + t T ) = P,   rows of the state     for a, N, T and v of massless parts
//
// For massless degrees of freedom without damping the equation itself determines u; its first derivative determines v, its
// second derivative a. For massless degrees of freedom with damping the equation determines v, its first derivative a.
#pragma once

#include "motion/taylor.hpp"

namespace signorini::motion {

class ConsistentMotion {
 public:
  explicit ConsistentMotion(StateSystems& systems) : taylor_(systems) {}

  /// Computes forces, accelerations and the v of massless degrees of freedom from u and v, and writes them into the point.
  void make(const StateSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 1 : 0, 1.0, series_);
    point = {series_.u.col(0), series_.u.col(1), series_.forces.col(0), 2.0 * series_.u.col(2)};
  }

  /// Computes all accelerations, including those of massless degrees of freedom, and writes them into the point. u, v and
  /// forces stay unchanged.
  void accelerate(const StateSystemPtr& system, const Forcing& forcing, double t, Point& point) {
    taylor_.expand(system, forcing, t, point.u, point.v, taylor_.massless() ? 2 : 0, 1.0, series_);
    point.a = 2.0 * series_.u.col(2);
  }

  /// True if there are massless degrees of freedom; only accelerate() determines all of their accelerations.
  [[nodiscard]] bool massless() const { return taylor_.massless(); }

 private:
  Taylor taylor_;
  Series series_;
};

}  // namespace signorini::motion
