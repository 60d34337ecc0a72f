// plot_ranges.hpp: axes of nearly constant curves.
//
//   least..greatest of a curve, m the middle, s the largest value of its kind in the run:
//   within 1e3 eps s of 0 rounding:   axis 0 +- 1e-3 s, a flat line
//   narrower than 2e-4 m  constant:   axis m (1 +- 0.01)
//   otherwise             gnuplot's automatic axis
//
// 1e3 eps: src/base/rounding.hpp. 2e-4: about ten tic labels with six digits are then all different. 1e-3, 0.01:
// chosen; the line looks flat beside numbers of a few digits.
#pragma once

#include <string>
#include <vector>

#include "result/plotted_run.hpp"

namespace signorini {

struct ContactScales {
  double length = 0.0, force = 0.0;
};
[[nodiscard]] ContactScales scales_of(const std::vector<ContactRanges>& ranges);

/// "set yrange [a:b]" and a line break, or "" for gnuplot's automatic axis.
[[nodiscard]] std::string steady(const Range& range, double scale);
/// True if the range is no more than rounding.
[[nodiscard]] bool is_rounding(const Range& range, double scale);

}  // namespace signorini
