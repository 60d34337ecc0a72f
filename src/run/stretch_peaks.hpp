// stretch_peaks.hpp: peaks in time of the largest value of p(x, t), a polynomial along a stretch at each time.
//
//   f_i(t)   the values at the points of the stretch, each at the Chebyshev points of the part (chebyshev.hpp)
//   bound    of the ends f_0, f_m, plus twice the bound of the distances of the others from the line between them
//   peak     x*(t) is the position of the largest p(., t); p_t(x*(t), t) = 0 with a change from + to -: the largest of
//            several smooth branches has kinks, but none of them is a peak
//
// The smallest value is minus the largest one of -p.
#pragma once

#include <span>
#include <vector>

#include "base/along.hpp"
#include "run/chebyshev.hpp"

namespace signorini {

struct ValueBounds {
  double least = 0.0, greatest = 0.0;
};

/// Bounds of one function at its points.
[[nodiscard]] ValueBounds at_points(const Chebyshev::Values& values, std::size_t stride);
/// Bounds between the points, too: if p rises at one and falls at the next, it stays below both tangents.
[[nodiscard]] ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride);

/// Bounds of p on the stretch; `between`: including the values between the times.
[[nodiscard]] ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                       bool between);

/// Times in [-1, 1], between the points, of peaks of p's largest (sign 1) or smallest (-1) value, if the tangents allow
/// a value above (below) `known`.
[[nodiscard]] std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                              double sign, double known);

/// Values along the stretch at time x.
[[nodiscard]] Along::Values values_along(std::span<const Chebyshev::Values> f, std::size_t stride, double x);

}  // namespace signorini
