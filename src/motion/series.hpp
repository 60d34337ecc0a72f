// series.hpp: coefficients of the motion's Taylor series.
//
//   u(t + s z) = sum_k u_k z^k,   N, T, g and ut likewise
#pragma once

#include "motion/forcing.hpp"

namespace signorini {

/// Coefficients about t, column k: order k. v follows from u; levels 0 .. `levels`.
struct Series {
  double t = 0.0, scale = 1.0;
  int levels = 0;
  Eigen::MatrixXd u;  ///< n x (levels + 3); complete to order `levels`, beyond only with mass
  ForceLayout layout;
  Eigen::MatrixXd forces;  ///< all contacts x (levels + 1)
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

/// Coefficient k of N of a contact with the normal row N = kn g + cn g', N = -q or N = 0, if u and v have mass: known
/// before level k is.
[[nodiscard]] inline double normal_coefficient(const Contact& contact, std::size_t index, const Form& row,
                                               const Series& series, std::size_t k) {
  const double* v = series.u.data() + (k + 1) * static_cast<std::size_t>(series.u.rows());
  ContactMotion m;
  m.gap = gap_coefficient(contact, series, k);
  m.vn = static_cast<double>(k + 1) / series.scale * contact.normal.dot(v);
  m.pressing = series.forcing.pressing[index * series.forcing.count + k];
  return -(k == 0 ? row.value(m) : row.rate(m));
}

}  // namespace signorini
