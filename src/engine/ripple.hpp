// ripple.hpp: bounds on the contribution of the fast part of a motion to any output.
//
//   |form . u| <= reach |u|_M,   reach^2 = form' M^-1 form,   |u|_M^2 = u' M u      (Cauchy and Schwarz)
//
// If the modes are known, |u|_M of all modes faster than a given rate is the square root of the sum of their squared
// amplitudes: no mode is summed separately, and each form is evaluated once. Sums over modes of the whole motion have a
// rounding error of a few eps reach |u|_M, wherever on the structure the form acts, also for a stress at a clamped end.
#pragma once

#include <Eigen/Core>

namespace signorini {

/// Bounds on a step. Units: |.|_M is a length times the square root of a mass, for v and a divided by time and time
/// squared; forces.
struct Ripple {
  double u = 0.0, v = 0.0, a = 0.0;
  Eigen::VectorXd forces;  ///< bounds of all contact forces, in the order of the model's layout
};

}  // namespace signorini
