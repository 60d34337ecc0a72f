// stretch_peaks.hpp: where p(x, t), a polynomial along a stretch at each time, may be greatest in a part of a step.
//
//   f_i(t)   the values at the points of the stretch, each at the Chebyshev points of the part (chebyshev.hpp)
//   bound    of the ends f_0, f_m, and twice that of what the others are off the line between them
//   peak     x*(t) is where p(., t) is greatest; p_t(x*(t), t) = 0 from above to below: the greatest of branches that
//            are smooth has kinks, but none of them is a peak
//
// The least is the greatest of -p.
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
/// With what lies between the points: where p rises from one and falls to the next, it stays below both tangents.
[[nodiscard]] ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride);

/// Bounds of p on the stretch; `between`: including the values between the times.
[[nodiscard]] ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                       bool between);

/// Times in [-1, 1] between the points, at which p's greatest (sign 1) or least (-1) value peaks, where by both
/// tangents it may be above `known` (below).
[[nodiscard]] std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                              double sign, double known);

/// Values along the stretch at a time.
[[nodiscard]] Along::Values values_along(std::span<const Chebyshev::Values> f, std::size_t stride, double x);

}  // namespace signorini
