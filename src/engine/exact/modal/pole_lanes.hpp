// pole_lanes.hpp: sums over the poles of a spectrum near one value l = home + own.
//
//   one_i = 1/(l - D_i),   two_i = one_i^2,   sum_i one_i w_i,   sum_i two_i w_i
//
// Lists of real and imaginary parts; sums are taken in four parts.
#pragma once

#include <cstddef>

#include "engine/exact/modal/plain_complex.hpp"

namespace signorini {

/// base + tiny: the poles; home_base + home_tiny: the pole from which own is measured. re, im: 1/(l - D_i).
void inverse_distances(const double* base, const double* tiny, std::ptrdiff_t n, double home_base,
                       double home_tiny, const Complex& own, double* re, double* im);
void square_all(const double* re, const double* im, std::ptrdiff_t n, double* square_re, double* square_im);
/// sum_i (re_i + i im_i) w_i
[[nodiscard]] Complex weighted(const double* re, const double* im, const double* w, std::ptrdiff_t n);
/// out_i = sum_a small_a side_ia / (D_i - l), side by columns of n.
void cauchy_vector(const double* base, const double* tiny, std::ptrdiff_t n, double home_base,
                   double home_tiny, double own, const double* small, const double* side, std::ptrdiff_t rank,
                   double* out);
[[nodiscard]] Complex sum_of_all(const double* re, const double* im, std::ptrdiff_t n);

}  // namespace signorini
