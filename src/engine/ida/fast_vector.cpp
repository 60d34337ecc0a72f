#include "engine/ida/fast_vector.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/simd.hpp"

namespace signorini::ida {
namespace {

constexpr int most = 6;  // number of vectors in a linear combination, at most: order 5 has six differences

using Index = sunindextype;

/// Computes z_j = sum_i f_i x_ij. T: Double4, or double for the remaining entries. z may be the same vector as x_0, but not the
/// same as another x_i.
template <class T, int count>
[[gnu::always_inline]] inline void combined(const double* f, const double* const* x, Index j, double* z) {
  T sum = f[0] * base::lanes_at<T>(x[0] + j).v;
  if constexpr (count > 1) sum += f[1] * base::lanes_at<T>(x[1] + j).v;
  if constexpr (count > 2) sum += f[2] * base::lanes_at<T>(x[2] + j).v;
  if constexpr (count > 3) sum += f[3] * base::lanes_at<T>(x[3] + j).v;
  if constexpr (count > 4) sum += f[4] * base::lanes_at<T>(x[4] + j).v;
  if constexpr (count > 5) sum += f[5] * base::lanes_at<T>(x[5] + j).v;
  base::lanes_at<T>(z + j).v = sum;
}

template <int count>
[[gnu::always_inline]] inline void combine(const double* c, N_Vector* vectors, double* z, Index n) {
  std::array<const double*, count> x{};
  std::array<double, count> f{};
  for (int i = 0; i < count; ++i) {
    x[static_cast<std::size_t>(i)] = NV_DATA_S(vectors[i]);
    f[static_cast<std::size_t>(i)] = c[i];
  }
  Index j = 0;
  for (; j + 3 < n; j += 4) combined<base::Double4, count>(f.data(), x.data(), j, z);
  for (; j < n; ++j) combined<double, count>(f.data(), x.data(), j, z);
}

/// Computes z = sum of c_i x_i. Drops trailing zero factors, because IDA evaluates y at the end of each step, where all factors
/// except the first are zero.
SIGNORINI_WIDE_LANES int linear_combination(int count, double* c, N_Vector* x, N_Vector z_vector) {
  const Index n = NV_LENGTH_S(z_vector);
  double* z = NV_DATA_S(z_vector);
  while (count > 1 && c[count - 1] == 0.0) --count;
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
    for (Index j = 0; j < n; ++j) z[j] += f * p[j];
  }
  return 0;
}

SIGNORINI_WIDE_LANES void linear_sum(double a, N_Vector x_vector, double b, N_Vector y_vector,
                                     N_Vector z_vector) {
  const Index n = NV_LENGTH_S(z_vector);
  const double *x = NV_DATA_S(x_vector), *y = NV_DATA_S(y_vector);
  double* z = NV_DATA_S(z_vector);
  Index j = 0;
  if (a == 1.0) {  // fast path: a is 1 in all sums of IDA's steps
    for (; j + 3 < n; j += 4)
      base::lanes_at<base::Double4>(z + j).v =
          base::lanes_at<base::Double4>(x + j).v + b * base::lanes_at<base::Double4>(y + j).v;
    for (; j < n; ++j) z[j] = x[j] + b * y[j];
    return;
  }
  for (; j + 3 < n; j += 4)
    base::lanes_at<base::Double4>(z + j).v =
        a * base::lanes_at<base::Double4>(x + j).v + b * base::lanes_at<base::Double4>(y + j).v;
  for (; j < n; ++j) z[j] = a * x[j] + b * y[j];
}

SIGNORINI_WIDE_LANES void scale(double c, N_Vector x_vector, N_Vector z_vector) {
  const Index n = NV_LENGTH_S(z_vector);
  const double* x = NV_DATA_S(x_vector);
  double* z = NV_DATA_S(z_vector);
  if (c == 1.0) {
    if (x != z) std::copy(x, x + n, z);
    return;
  }
  Index j = 0;
  for (; j + 3 < n; j += 4)
    base::lanes_at<base::Double4>(z + j).v = c * base::lanes_at<base::Double4>(x + j).v;
  for (; j < n; ++j) z[j] = c * x[j];
}

void constant(double c, N_Vector z_vector) {
  double* z = NV_DATA_S(z_vector);
  std::fill(z, z + NV_LENGTH_S(z_vector), c);
}

/// Computes x_0j += e_j, then x_ij += x_(i-1)j for i = 1, 2, ...
template <class T, int count>
[[gnu::always_inline]] inline void cascaded(const double* e, double* const* x, Index j) {
  T sum = base::lanes_at<T>(e + j).v + base::lanes_at<T>(x[0] + j).v;
  base::lanes_at<T>(x[0] + j).v = sum;
  if constexpr (count > 1) base::lanes_at<T>(x[1] + j).v = sum += base::lanes_at<T>(x[1] + j).v;
  if constexpr (count > 2) base::lanes_at<T>(x[2] + j).v = sum += base::lanes_at<T>(x[2] + j).v;
  if constexpr (count > 3) base::lanes_at<T>(x[3] + j).v = sum += base::lanes_at<T>(x[3] + j).v;
  if constexpr (count > 4) base::lanes_at<T>(x[4] + j).v = sum += base::lanes_at<T>(x[4] + j).v;
  if constexpr (count > 5) base::lanes_at<T>(x[5] + j).v = sum += base::lanes_at<T>(x[5] + j).v;
}

/// Updates IDA's differences `vectors` = [phi_q, ..., phi_0]: adds the correction e to phi_q, and to each other vector the
/// updated vector before it in the list.
template <int count>
[[gnu::always_inline]] inline void cascade(const double* e, N_Vector* vectors, Index n) {
  std::array<double*, count> x{};
  for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = NV_DATA_S(vectors[i]);
  Index j = 0;
  for (; j + 3 < n; j += 4) cascaded<base::Double4, count>(e, x.data(), j);
  for (; j < n; ++j) cascaded<double, count>(e, x.data(), j);
}

SIGNORINI_WIDE_LANES int linear_sums(int count, double a, N_Vector* x, double b, N_Vector* y, N_Vector* z) {
  bool cascades = a == 1.0 && b == 1.0 && count >= 1 && count <= most;
  for (int i = 0; i < count && cascades; ++i) cascades = z[i] == x[i] && (i == 0 || y[i] == x[i - 1]);
  if (!cascades) {
    for (int i = 0; i < count; ++i) linear_sum(a, x[i], b, y[i], z[i]);
    return 0;
  }
  const Index n = NV_LENGTH_S(x[0]);
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

SIGNORINI_WIDE_LANES double wrms_norm(N_Vector x_vector, N_Vector w_vector) {
  const Index n = NV_LENGTH_S(x_vector);
  const double *x = NV_DATA_S(x_vector), *w = NV_DATA_S(w_vector);
  // Four independent sums of four lanes: in a single sum, each addition would wait for the previous one.
  base::Double4 s0{}, s1{}, s2{}, s3{};
  Index j = 0;
  for (; j + 15 < n; j += 16) {
    const base::Double4 p0 = base::lanes_at<base::Double4>(x + j).v * base::lanes_at<base::Double4>(w + j).v,
                        p1 = base::lanes_at<base::Double4>(x + j + 4).v *
                             base::lanes_at<base::Double4>(w + j + 4).v,
                        p2 = base::lanes_at<base::Double4>(x + j + 8).v *
                             base::lanes_at<base::Double4>(w + j + 8).v,
                        p3 = base::lanes_at<base::Double4>(x + j + 12).v *
                             base::lanes_at<base::Double4>(w + j + 12).v;
    s0 += p0 * p0;
    s1 += p1 * p1;
    s2 += p2 * p2;
    s3 += p3 * p3;
  }
  for (; j + 3 < n; j += 4) {
    const base::Double4 p = base::lanes_at<base::Double4>(x + j).v * base::lanes_at<base::Double4>(w + j).v;
    s0 += p * p;
  }
  double rest = 0.0;
  for (; j < n; ++j) rest += (x[j] * w[j]) * (x[j] * w[j]);
  const base::Double4 s = (s0 + s1) + (s2 + s3);
  return std::sqrt(((s[0] + s[1]) + (s[2] + s[3]) + rest) / static_cast<double>(n));
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

}  // namespace signorini::ida
