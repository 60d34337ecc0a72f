// series.hpp: coefficients of the motion's Taylor series.
//
//   u(t + s z) = sum_k u_k z^k,   N and T likewise
#pragma once

#include "motion/forcing.hpp"

namespace signorini {

/// Coefficients about t, column k: order k. v is that of u; levels 0 .. `levels`.
struct Series {
  double t = 0.0, scale = 1.0;
  int levels = 0;
  Eigen::MatrixXd u;       ///< n x (levels + 3); complete to order `levels`, beyond only where there is mass
  Eigen::MatrixXd forces;  ///< 2 contacts x (levels + 1): N_1, T_1, N_2, ...
  ForcingSeries forcing;   ///< levels + 3 coefficients
};

}  // namespace signorini
