// series.hpp: coefficients of the motion's Taylor series.
//
//   u(t + s z) = sum_k u_k z^k,   N, T, g and ut likewise
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

/// Coefficient k of g = g0 + n . u, and of ut = t . u - s at contact number `index`.
[[nodiscard]] inline double gap_coefficient(const Contact& contact, const Series& series, std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return k == 0 ? contact.gap_at(u) : contact.normal.dot(u);
}
[[nodiscard]] inline double ut_coefficient(const Contact& contact, std::size_t index, const Series& series,
                                           std::size_t k) {
  const double* u = series.u.data() + k * static_cast<std::size_t>(series.u.rows());
  return contact.tangent.dot(u) - series.forcing.surface[index * series.forcing.count + k];
}

}  // namespace signorini
