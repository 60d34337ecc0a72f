// newmark_works.hpp: work of the loads and dissipation in a step of average acceleration.
//
//   loads     1/2 (P0 + P1) . du
//   damping   h v^T C v + sum_closed cn vn dg          v, vn: means of both ends
//   friction  1/2 (T0 + T1) dp
//   surface  -1/2 (T0 + T1) ds
//
// With these works the energy balance of a step holds to rounding: it is that of the trapezoidal rule, which conserves
// the energy of a linear system.
#pragma once

#include "motion/powers.hpp"

namespace signorini {

class NewmarkWorks {
 public:
  NewmarkWorks(const Model& model, const Structure& structure)
      : model_(model), structure_(structure), du_(model.size()), v_(model.size()) {}

  /// works += factor * the works of the step from `a` at t0 to `b` at t1, in one mode.
  void add(const Forcing& forcing, const Mode& mode, const Point& a, double t0, const Point& b, double t1,
           double factor, Works& works);

 private:
  const Model& model_;
  const Structure& structure_;
  Vector du_, v_;
};

}  // namespace signorini
