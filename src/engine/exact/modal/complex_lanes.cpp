#include "engine/exact/modal/complex_lanes.hpp"

#include "base/simd.hpp"

namespace signorini::modal {
namespace {

template <class T>
[[gnu::always_inline]] inline void inverse_distance(const double* base, const double* tiny, double home_base,
                                                    double home_tiny, double own_re, double own_im,
                                                    double* re, double* im) {
  const T apart =
      own_re - ((base::lanes_at<T>(base).v - home_base) + (base::lanes_at<T>(tiny).v - home_tiny));
  const T factor = 1.0 / (apart * apart + own_im * own_im);
  base::lanes_at<T>(re).v = apart * factor;
  base::lanes_at<T>(im).v = -own_im * factor;
}

template <class T>
[[gnu::always_inline]] inline void square_one(const double* re, const double* im, double* square_re,
                                              double* square_im) {
  const T a = base::lanes_at<T>(re).v, b = base::lanes_at<T>(im).v;
  base::lanes_at<T>(square_re).v = a * a - b * b;
  base::lanes_at<T>(square_im).v = 2.0 * a * b;
}

template <class T>
[[gnu::always_inline]] inline void cauchy_entry(const double* base, const double* tiny, double home_base,
                                                double home_tiny, double own, const double* small,
                                                const double* side, std::ptrdiff_t n, std::ptrdiff_t rank,
                                                double* out) {
  T sum = {};
  for (std::ptrdiff_t a = 0; a < rank; ++a) sum += small[a] * base::lanes_at<T>(side + a * n).v;
  base::lanes_at<T>(out).v =
      sum / (((base::lanes_at<T>(base).v - home_base) + (base::lanes_at<T>(tiny).v - home_tiny)) - own);
}

}  // namespace

SIGNORINI_WIDE_LANES void cauchy_vector(const double* base, const double* tiny, std::ptrdiff_t n,
                                        double home_base, double home_tiny, double own, const double* small,
                                        const double* side, std::ptrdiff_t rank, double* out) {
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4)
    cauchy_entry<base::Double4>(base + i, tiny + i, home_base, home_tiny, own, small, side + i, n, rank,
                                out + i);
  for (; i < n; ++i)
    cauchy_entry<double>(base + i, tiny + i, home_base, home_tiny, own, small, side + i, n, rank, out + i);
}

SIGNORINI_WIDE_LANES void inverse_distances(const double* base, const double* tiny, std::ptrdiff_t n,
                                            double home_base, double home_tiny, const Complex& own,
                                            double* re, double* im) {
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4)
    inverse_distance<base::Double4>(base + i, tiny + i, home_base, home_tiny, own.re, own.im, re + i, im + i);
  for (; i < n; ++i)
    inverse_distance<double>(base + i, tiny + i, home_base, home_tiny, own.re, own.im, re + i, im + i);
}

SIGNORINI_WIDE_LANES void square_all(const double* re, const double* im, std::ptrdiff_t n, double* square_re,
                                     double* square_im) {
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) square_one<base::Double4>(re + i, im + i, square_re + i, square_im + i);
  for (; i < n; ++i) square_one<double>(re + i, im + i, square_re + i, square_im + i);
}

SIGNORINI_WIDE_LANES Complex weighted_sum(const double* re, const double* im, const double* w,
                                          std::ptrdiff_t n) {
  base::Double4 sum_re = {}, sum_im = {};
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) {
    const base::Double4 weight = base::lanes_at<base::Double4>(w + i).v;
    sum_re += base::lanes_at<base::Double4>(re + i).v * weight;
    sum_im += base::lanes_at<base::Double4>(im + i).v * weight;
  }
  for (int lane = 0; i < n; ++i, ++lane) {
    sum_re[lane] += re[i] * w[i];
    sum_im[lane] += im[i] * w[i];
  }
  return {base::sum_of_lanes(sum_re), base::sum_of_lanes(sum_im)};
}

SIGNORINI_WIDE_LANES Complex complex_sum(const double* re, const double* im, std::ptrdiff_t n) {
  base::Double4 sum_re = {}, sum_im = {};
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) {
    sum_re += base::lanes_at<base::Double4>(re + i).v;
    sum_im += base::lanes_at<base::Double4>(im + i).v;
  }
  for (int lane = 0; i < n; ++i, ++lane) {
    sum_re[lane] += re[i];
    sum_im[lane] += im[i];
  }
  return {base::sum_of_lanes(sum_re), base::sum_of_lanes(sum_im)};
}

}  // namespace signorini::modal
