#include "engine/exact/modal/mode_pairs.hpp"

#include "base/simd.hpp"

namespace signorini::modal {

void pairs_of_mode(const Spectrum& spectrum, double alpha, Eigen::Index k, double* shared) {
  const std::vector<double>& values = spectrum.real();
  const auto own = static_cast<std::size_t>(k);
  const double lk = values[own];
  for (std::size_t i = 0; i < own; ++i) {
    const double l = values[i], d = l - lk, all = d * d + 2.0 * alpha * alpha * (l + lk);
    shared[i] = all == 0.0 ? 0.0 : spectrum.product(own, i) / all;
  }
}

ModePairs::ModePairs(const Spectrum& spectrum, double alpha) {
  const std::size_t n = spectrum.real().size();
  shared_.resize(n * (n - 1) / 2);
  double* next = shared_.data();
  for (std::size_t k = 1; k < n; next += k, ++k)
    pairs_of_mode(spectrum, alpha, static_cast<Eigen::Index>(k), next);
}

namespace {

/// Terms of pair_integrals() for mode i (T = double), or for modes i to i + 3 (T = Double4).
template <class T>
[[gnu::always_inline]] inline void meet(const ModeEnds& a, double alpha, std::ptrdiff_t k, std::ptrdiff_t i,
                                        const double* shared, double* yy_out, double* mixed_out, T& sum) {
  const double lk = a.l[k], y0 = a.y0[k], r0 = a.r0[k], y1 = a.y1[k], r1 = a.r1[k];
  const T l = base::lanes_at<T>(a.l + i).v, at_begin = base::lanes_at<T>(a.y0 + i).v,
          at_end = base::lanes_at<T>(a.y1 + i).v;
  const T rate0 = base::lanes_at<T>(a.r0 + i).v, rate1 = base::lanes_at<T>(a.r1 + i).v;
  const T d = l - lk, both = l + lk, e = 1.0 / (d * d + (2.0 * alpha * alpha) * both);
  const T yy = y1 * at_end - y0 * at_begin, pulled = l * yy, rr = r1 * rate1 - r0 * rate0;
  const T turned = lk * (y1 * rate1 - y0 * rate0) - l * (r1 * at_end - r0 * at_begin);
  base::lanes_at<T>(yy_out + i).v = yy;
  base::lanes_at<T>(mixed_out + i).v =
      e * ((d + 2.0 * alpha * alpha) * pulled + d * rr - (2.0 * alpha) * turned);
  sum += base::lanes_at<T>(shared + i).v * ((2.0 * alpha * lk) * pulled + (alpha * both) * rr + d * turned);
}

}  // namespace

SIGNORINI_WIDE_LANES double pair_integrals(const ModeEnds& ends, double alpha, std::ptrdiff_t k,
                                           const double* shared, double* yy, double* mixed) {
  base::Double4 sum = {};
  std::ptrdiff_t i = 0;
  for (; i + 4 <= k; i += 4) meet<base::Double4>(ends, alpha, k, i, shared, yy, mixed, sum);
  for (int lane = 0; i < k; ++i, ++lane) {
    double own = 0.0;
    meet<double>(ends, alpha, k, i, shared, yy, mixed, own);
    sum[lane] += own;
  }
  return base::sum_of_lanes(sum);
}

SIGNORINI_WIDE_LANES double cross_integral(const double* n, const double* t, std::ptrdiff_t k,
                                           const double* yy, const double* mixed) {
  base::Double4 to_t = {}, to_n = {};
  std::ptrdiff_t i = 0;
  for (; i + 4 <= k; i += 4) {
    const base::Double4 both = base::lanes_at<base::Double4>(mixed + i).v;
    to_t += base::lanes_at<base::Double4>(t + i).v * both;
    to_n += base::lanes_at<base::Double4>(n + i).v * (base::lanes_at<base::Double4>(yy + i).v - both);
  }
  for (int lane = 0; i < k; ++i, ++lane) {
    to_t[lane] += t[i] * mixed[i];
    to_n[lane] += n[i] * (yy[i] - mixed[i]);
  }
  return n[k] * base::sum_of_lanes(to_t) + t[k] * base::sum_of_lanes(to_n);
}

}  // namespace signorini::modal
