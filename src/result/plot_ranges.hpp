// plot_ranges.hpp: axes of curves that hardly move.
//
//   least..greatest of a curve, m the middle, s the greatest of its kind in the run:
//   within 1e3 eps s of 0 rounding:   axis 0 +- 1e-3 s, a flat line
//   narrower than 2e-4 m  constant:   axis m (1 +- 0.01)
//   else                  as gnuplot finds it
//
// 1e3 eps: src/base/rounding.hpp. 2e-4: labels of six digits on some ten ticks, all different. 1e-3, 0.01: chosen, a line that looks flat beside figures of a few digits.
#pragma once

#include <string>
#include <vector>

#include "result/plotted_run.hpp"

namespace signorini {

struct ContactScales {
  double length = 0.0, force = 0.0;
};
[[nodiscard]] ContactScales scales_of(const std::vector<ContactRanges>& ranges);

/// "set yrange [a:b]" and a line break, or nothing.
[[nodiscard]] std::string steady(const Range& range, double scale);
/// Whether it is rounding and no more.
[[nodiscard]] bool is_rounding(const Range& range, double scale);

}  // namespace signorini
