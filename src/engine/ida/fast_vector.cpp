#include "engine/ida/fast_vector.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// Before a loop: no pass reads what another one writes, whatever the pointers look like.
#ifdef __clang__
#define SIGNORINI_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define SIGNORINI_INDEPENDENT _Pragma("GCC ivdep")
#endif

namespace signorini {
namespace {

constexpr int most = 6;  // vectors of a linear combination: order 5 has six differences

/// z may be x[0]; later ones are distinct from it.
template <int count>
void combine(const double* c, N_Vector* x, double* z, sunindextype n) {
  std::array<const double*, most> p{};
  std::array<double, most> f{};
  for (int i = 0; i < count; ++i) {
    p[static_cast<std::size_t>(i)] = NV_DATA_S(x[i]);
    f[static_cast<std::size_t>(i)] = c[i];
  }
  SIGNORINI_INDEPENDENT
  for (sunindextype j = 0; j < n; ++j) {
    double sum = f[0] * p[0][j];
    if constexpr (count > 1) sum += f[1] * p[1][j];
    if constexpr (count > 2) sum += f[2] * p[2][j];
    if constexpr (count > 3) sum += f[3] * p[3][j];
    if constexpr (count > 4) sum += f[4] * p[4][j];
    if constexpr (count > 5) sum += f[5] * p[5][j];
    z[j] = sum;
  }
}

int linear_combination(int count, double* c, N_Vector* x, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  double* z = NV_DATA_S(z_vector);
  switch (std::min(count, most)) {
    case 1:
      combine<1>(c, x, z, n);
      break;
    case 2:
      combine<2>(c, x, z, n);
      break;
    case 3:
      combine<3>(c, x, z, n);
      break;
    case 4:
      combine<4>(c, x, z, n);
      break;
    case 5:
      combine<5>(c, x, z, n);
      break;
    default:
      combine<6>(c, x, z, n);
  }
  for (int i = most; i < count; ++i) {
    const double *p = NV_DATA_S(x[i]), f = c[i];
    SIGNORINI_INDEPENDENT
    for (sunindextype j = 0; j < n; ++j) z[j] += f * p[j];
  }
  return 0;
}

void linear_sum(double a, N_Vector x_vector, double b, N_Vector y_vector, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  const double *x = NV_DATA_S(x_vector), *y = NV_DATA_S(y_vector);
  double* z = NV_DATA_S(z_vector);
  SIGNORINI_INDEPENDENT
  for (sunindextype j = 0; j < n; ++j) z[j] = a * x[j] + b * y[j];
}

void scale(double c, N_Vector x_vector, N_Vector z_vector) {
  const sunindextype n = NV_LENGTH_S(z_vector);
  const double* x = NV_DATA_S(x_vector);
  double* z = NV_DATA_S(z_vector);
  if (c == 1.0) {
    if (x != z) std::copy(x, x + n, z);
    return;
  }
  SIGNORINI_INDEPENDENT
  for (sunindextype j = 0; j < n; ++j) z[j] = c * x[j];
}

void constant(double c, N_Vector z_vector) {
  double* z = NV_DATA_S(z_vector);
  std::fill(z, z + NV_LENGTH_S(z_vector), c);
}

/// IDA's x = [phi_q, ..., phi_0], z = [e, phi_q, ..., phi_1]: with x_0 += e, then x_i += x_(i-1).
template <int count>
void cascade(const double* e, N_Vector* x_vector, sunindextype n) {
  std::array<double*, most> x{};
  for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = NV_DATA_S(x_vector[i]);
  SIGNORINI_INDEPENDENT
  for (sunindextype j = 0; j < n; ++j) {
    double sum = e[j] + x[0][j];
    x[0][j] = sum;
    if constexpr (count > 1) x[1][j] = sum += x[1][j];
    if constexpr (count > 2) x[2][j] = sum += x[2][j];
    if constexpr (count > 3) x[3][j] = sum += x[3][j];
    if constexpr (count > 4) x[4][j] = sum += x[4][j];
    if constexpr (count > 5) x[5][j] = sum += x[5][j];
  }
}

int linear_sums(int count, double a, N_Vector* x, double b, N_Vector* y, N_Vector* z) {
  bool cascades = a == 1.0 && b == 1.0 && count >= 1 && count <= most;
  for (int i = 0; i < count && cascades; ++i) cascades = z[i] == x[i] && (i == 0 || y[i] == x[i - 1]);
  if (!cascades) {
    for (int i = 0; i < count; ++i) linear_sum(a, x[i], b, y[i], z[i]);
    return 0;
  }
  const sunindextype n = NV_LENGTH_S(x[0]);
  const double* e = NV_DATA_S(y[0]);
  switch (count) {
    case 1:
      cascade<1>(e, x, n);
      break;
    case 2:
      cascade<2>(e, x, n);
      break;
    case 3:
      cascade<3>(e, x, n);
      break;
    case 4:
      cascade<4>(e, x, n);
      break;
    case 5:
      cascade<5>(e, x, n);
      break;
    default:
      cascade<6>(e, x, n);
  }
  return 0;
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
  v->ops->nvlinearsumvectorarray = linear_sums;
  v->ops->nvscale = scale;
  v->ops->nvconst = constant;
  v->ops->nvwrmsnorm = wrms_norm;
  return v;
}

}  // namespace signorini
