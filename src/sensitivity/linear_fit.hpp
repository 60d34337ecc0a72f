// linear_fit.hpp: linearised least-squares problem at one point.
//
//   J = U S V^T D      D: norms of J's columns
//   step = - D^-1 V S^+ U^T f                    minimises |f + J step|
//   covariance = D^-1 V (S^+)^2 V^T D^-1
//
// S^+: without singular values that are zero to rounding. Keys with a component there are undetermined.
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

/// f: residuals over their sigmas; J: their derivatives; size: size of each key; measured: norm of the measured numbers
/// over their sigmas, to which rounding is relative. rows >= keys.
[[nodiscard]] LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                                   double measured);

}  // namespace signorini
