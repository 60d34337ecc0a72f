// summed_curves.hpp: the sum of lines that have their points at times of their own.
//
//   s(t) = sum_i y_i(t)     y_i: straight between its points, two of one time are a jump, a jump of s, too
//
// Before its first point and after its last a line stays where it is.
#pragma once

#include "signorini/result.hpp"

namespace signorini {

/// Each line: t >= 0 ascends, and may repeat. Thinned to `most` points or so (base/thinned.hpp).
[[nodiscard]] std::vector<CurvePoint> summed(const std::vector<const std::vector<CurvePoint>*>& lines,
                                             std::size_t most);

}  // namespace signorini
