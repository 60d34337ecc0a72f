// rounding.hpp: bounds of rounding errors in double precision; all multiples of eps are defined here.
//
//   |fl(x op y) - (x op y)| <= eps/2 |x op y|,      eps = 2^-52
//
// A computed number is treated as zero if it is below c eps times the sum of the magnitudes of its terms. c is dimensionless
// and the terms have a unit, so a test for zero does not depend on units or axes.
//
//   c    for                                         reason
//   4    products and sums of two or three terms     at most 8 operations of eps/2
//   64   sums of many terms, solves, differences     128 operations of eps/2 at worst; about 10^4 with
//                                                    random errors, as sqrt(n) eps/2
//   100  times                                       IDA treats times as equal up to this difference
//   1000 solutions of small dense problems           about n^2 operations of eps/2 per row, n = 24 (six contacts)
//
// Results of solves with larger matrices have the backward error of the solve instead.
#pragma once

#include <limits>

namespace signorini::rounding {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double few_operations = 4.0 * eps;
inline constexpr double many_operations = 64.0 * eps;
inline constexpr double time_resolution = 100.0 * eps;
inline constexpr double elimination = 1e3 * eps;

}  // namespace signorini::rounding
