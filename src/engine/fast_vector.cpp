#include "engine/fast_vector.hpp"

#include <nvector/nvector_serial.h>

#include <cmath>

namespace signorini {
namespace {

int linear_combination(int count, double* c, N_Vector* x, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  double* z = NV_DATA_S(z_vector);
  // z may be x[0]; later ones are distinct. Terms go in pairs: half the passes over z.
  const double *a = NV_DATA_S(x[0]), c0 = c[0];
  int i = 1;
  if (count == 1) {
    for (sunindextype j = 0; j < n; ++j) z[j] = c0 * a[j];
    return 0;
  }
  {
    const double *b = NV_DATA_S(x[1]), c1 = c[1];
#pragma GCC ivdep
    for (sunindextype j = 0; j < n; ++j) z[j] = c0 * a[j] + c1 * b[j];
    i = 2;
  }
  for (; i + 1 < count; i += 2) {
    const double *p = NV_DATA_S(x[i]), *q = NV_DATA_S(x[i + 1]), cp = c[i], cq = c[i + 1];
#pragma GCC ivdep
    for (sunindextype j = 0; j < n; ++j) z[j] += cp * p[j] + cq * q[j];
  }
  if (i < count) {
    const double *p = NV_DATA_S(x[i]), cp = c[i];
#pragma GCC ivdep
    for (sunindextype j = 0; j < n; ++j) z[j] += cp * p[j];
  }
  return 0;
}

void linear_sum(double a, N_Vector x_vector, double b, N_Vector y_vector, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  const double *x = NV_DATA_S(x_vector), *y = NV_DATA_S(y_vector);
  double* z = NV_DATA_S(z_vector);
#pragma GCC ivdep
  for (sunindextype j = 0; j < n; ++j) z[j] = a * x[j] + b * y[j];
}

void scale(double c, N_Vector x_vector, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  const double* x = NV_DATA_S(x_vector);
  double* z = NV_DATA_S(z_vector);
#pragma GCC ivdep
  for (sunindextype j = 0; j < n; ++j) z[j] = c * x[j];
}

double wrms_norm(N_Vector x_vector, N_Vector w_vector) {
  const sunindextype n = NV_LENGTH_S(x_vector);
  const double *x = NV_DATA_S(x_vector), *w = NV_DATA_S(w_vector);
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
  sunindextype j = 0;
  for (; j + 3 < n; j += 4) {
    const double p0 = x[j] * w[j], p1 = x[j + 1] * w[j + 1], p2 = x[j + 2] * w[j + 2],
                 p3 = x[j + 3] * w[j + 3];
    s0 += p0 * p0;
    s1 += p1 * p1;
    s2 += p2 * p2;
    s3 += p3 * p3;
  }
  for (; j < n; ++j) s0 += (x[j] * w[j]) * (x[j] * w[j]);
  return std::sqrt((s0 + s1 + s2 + s3) / static_cast<double>(n));
}

}  // namespace

N_Vector make_vector(sunindextype size, SUNContext context) {
  N_Vector v = N_VNew_Serial(size, context);
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvwrmsnorm = wrms_norm;
  return v;
}

}  // namespace signorini
