// ripple.hpp: what the fast part of a motion may add to anything that is asked of it.
//
//   |form . u| <= reach |u|_M,   reach^2 = form' M^-1 form,   |u|_M^2 = u' M u      (Cauchy and Schwarz)
//
// Where modes are known |u|_M of those faster than a rate is the root of the sum of the squares of their amplitudes:
// no mode is summed up by itself, and no form but once. What sums over modes make of all motion together is known to
// some roundings of  reach |u|_M,  wherever on the structure the form looks: a stress at a clamped end, too.
#pragma once

#include <Eigen/Core>

namespace signorini {

/// Bounds on a step. Units: |.|_M a length times the root of a mass, v and a over time; forces.
struct Ripple {
  double u = 0.0, v = 0.0, a = 0.0;
  Eigen::VectorXd forces;  ///< of all contacts, in the order of the model's layout
};

}  // namespace signorini
