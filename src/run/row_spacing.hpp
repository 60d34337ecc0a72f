// row_spacing.hpp: distance of rows such that straight lines between them represent the curve.
//
//   rows at a, b, c:   y_b is off the line from y_a to y_c by   d = |y''| (b - a) (c - b) / 2
//   rows h apart:      h^2 = (b - a) (c - b) bend R / d   rows are off by bend R, lines between them by a quarter of it
//
// R: the range of y. A curve with amplitude A = R / 2 has 47 rows per period at its turning points. The existing rows
// determine h, and need not have equal distances.
#pragma once

#include <cmath>
#include <limits>

namespace signorini {

/// Fraction of the range. Half of a curve's first bend passes before rows detect it, and thinned rows are off by 0.3 %
/// (base/thinned.hpp). Chosen value; the test "what pictures draw of contacts is the motion" depends on it.
inline constexpr double most_bend = 0.0045;
/// Fraction of the run: 26 rows per pixel of the widest picture.
inline constexpr double closest_rows = 1.0 / 32000.0;

/// Spacing h of one curve; left, right: b - a and c - b, off: d. Infinite for a straight line.
[[nodiscard]] inline double spacing_for(double left, double right, double off, double range) {
  if (!(off > 0.0) || !(range > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(left * right * most_bend * range / off);
}

}  // namespace signorini
