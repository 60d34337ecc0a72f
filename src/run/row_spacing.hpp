// row_spacing.hpp: how close rows must be so that straight lines between them are the curve.
//
//   rows at a, b, c:   y_b is off the line from y_a to y_c by   d = |y''| (b - a) (c - b) / 2
//   rows h apart:      h^2 = (b - a) (c - b) bend R / d         they are off by bend R, lines between them by a quarter of it
//
// R: the range of y. A curve that swings by A = R / 2 has 47 rows a period where it turns. h follows from whatever rows there
// are: those of contacts and of curves need not be equally close.
#pragma once

#include <cmath>
#include <limits>

namespace signorini {

/// Of the range. Half of a curve's first bend goes by before rows tell of it, and thinned rows leave out 0.3 %
/// (base/thinned.hpp): chosen, "what pictures draw of contacts is the motion" moves when it does.
inline constexpr double most_bend = 0.0045;
/// Relative to the run: 26 rows per pixel of the widest picture.
inline constexpr double closest_rows = 1.0 / 32000.0;

/// h of one curve; left, right: b - a and c - b, off: d. Infinite where it does not bend.
[[nodiscard]] inline double spacing_for(double left, double right, double off, double range) {
  if (!(off > 0.0) || !(range > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(left * right * most_bend * range / off);
}

}  // namespace signorini
