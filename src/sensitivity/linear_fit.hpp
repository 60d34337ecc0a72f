// linear_fit.hpp: what a least-squares problem says at one point, to first order.
//
//   J = U S V^T D      D: norms of J's columns
//   step = - D^-1 V S^+ U^T f                    to where |f + J step| is least
//   covariance = D^-1 V (S^+)^2 V^T D^-1
//
// S^+: without what is zero to rounding. Keys that take part in it are not determined.
#pragma once

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <memory>
#include <vector>

namespace signorini {

struct GslFree {
  void operator()(gsl_matrix* m) const { gsl_matrix_free(m); }
  void operator()(gsl_vector* v) const { gsl_vector_free(v); }
};
using GslMatrix = std::unique_ptr<gsl_matrix, GslFree>;
using GslVector = std::unique_ptr<gsl_vector, GslFree>;

struct LinearFit {
  std::vector<double> step, slope;  ///< slope: J^T f
  std::vector<std::vector<double>> covariance;
  std::vector<bool> determined;
  std::size_t rank = 0;
};

/// f: residuals over their sigmas; J: their derivatives; size: of each key; measured: the norm of what was measured over
/// its sigmas, to which rounding is relative. rows >= keys.
[[nodiscard]] LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                                   double measured);

}  // namespace signorini
