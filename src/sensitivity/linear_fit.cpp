#include "sensitivity/linear_fit.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

// Derivatives are accurate to 1e-9 or better, since the model's data are differenced with that accuracy (stencils.hpp).
// A change of the measured numbers below this fraction, for a change of a key by its own size, is rounding.
constexpr double rounding_of_rates = 1e-9;
// Relative to the largest singular value of J with columns of norm 1. For two keys with the same effect rounding leaves
// about 1e-9; chosen in the middle between that and 1e-3, where measurements may still distinguish two keys.
constexpr double dependent = 1e-6;
// Component of a key, relative to 1, in an undetermined combination. Chosen value: far above rounding / dependent.
constexpr double takes_part = 1e-2;

}  // namespace

LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                     double measured) {
  const std::size_t rows = J.size1, keys = J.size2;
  LinearFit fit{
      std::vector<double>(keys, 0.0), std::vector<double>(keys, 0.0), {}, std::vector<bool>(keys, true), 0};
  fit.covariance.assign(keys, std::vector<double>(keys, 0.0));
  const GslMatrix U(gsl_matrix_alloc(rows, keys)), V(gsl_matrix_alloc(keys, keys));
  const GslVector S(gsl_vector_alloc(keys));
  gsl_matrix_memcpy(U.get(), &J);
  std::vector<double> norm(keys);
  for (std::size_t j = 0; j < keys; ++j) {
    gsl_vector_view column = gsl_matrix_column(U.get(), j);
    gsl_blas_ddot(&column.vector, &f, &fit.slope[j]);
    norm[j] = gsl_blas_dnrm2(&column.vector);
    fit.determined[j] = norm[j] * size[j] > rounding_of_rates * measured;
    gsl_vector_scale(&column.vector, fit.determined[j] ? 1.0 / norm[j] : 0.0);
  }
  gsl_linalg_SV_decomp_jacobi(U.get(), V.get(), S.get());
  const double greatest = gsl_vector_max(S.get());
  for (std::size_t k = 0; k < keys; ++k) {
    const double s = gsl_vector_get(S.get(), k);
    if (!(s > dependent * greatest)) {
      for (std::size_t j = 0; j < keys; ++j)
        if (std::abs(gsl_matrix_get(V.get(), j, k)) > takes_part) fit.determined[j] = false;
      continue;
    }
    ++fit.rank;
    double along = 0.0;
    const gsl_vector_const_view u = gsl_matrix_const_column(U.get(), k);
    gsl_blas_ddot(&u.vector, &f, &along);
    for (std::size_t i = 0; i < keys; ++i) {
      if (norm[i] == 0.0) continue;
      const double vi = gsl_matrix_get(V.get(), i, k) / norm[i];
      fit.step[i] -= vi * along / s;
      for (std::size_t j = 0; j < keys; ++j)
        if (norm[j] > 0.0) fit.covariance[i][j] += vi * gsl_matrix_get(V.get(), j, k) / norm[j] / (s * s);
    }
  }
  return fit;
}

}  // namespace signorini
