// output_value.hpp: value of an output at one instant.
//
//   linear       r = u.u + v.v + a.a + sum_k ( N_k N + T_k T ) + sum_i h_i(t) + constant
//                    + sum_k c_k ( |N| - N_0 ) t.u
//   stretches    r = largest |p(x)|, p through the linear outputs at their points (base/along.hpp);
//                with the largest p, the smallest p, and their positions
#pragma once

#include "base/along.hpp"
#include "motion/jet.hpp"
#include "run/audit.hpp"

namespace signorini {

struct OutputReading {
  double value = 0.0, greatest = 0.0, least = 0.0;
  OutputPlace at_greatest, at_least;
};

/// Value of a linear output; losses: of all contacts.
[[nodiscard]] double value_of(const Output& output, double t, Side side, const Point& point,
                              const ForceLayout& layout, const std::vector<double>& losses);
[[nodiscard]] OutputReading reading_of(const Output& output, double t, Side side, const Point& point,
                                       const ForceLayout& layout, const std::vector<double>& losses);
/// Extremes along the i-th stretch, with their positions.
[[nodiscard]] OutputReading along_stretch(const Output& output, std::size_t i, const Along::Values& values);

/// Sum of the absolute terms of a linear output, to which rounding is relative.
[[nodiscard]] double magnitude_of(const Output& output, double t, Side side, const Point& point,
                                  const ForceLayout& layout);

}  // namespace signorini
