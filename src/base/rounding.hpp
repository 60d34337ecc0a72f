// rounding.hpp: what a double cannot tell apart; the one home of multiples of eps.
//
//   |fl(x op y) - (x op y)| <= eps/2 |x op y|,      eps = 2^-52
//
// A computed number counts as zero below c eps times the sum of the magnitudes of its terms. c has no unit;
// the unit is that of the terms, so a zero test changes with neither units nor axes.
//
//   c    for                                         why
//   4    products and sums of two or three terms     at most 8 operations of eps/2
//   64   sums of many terms, solves, differences     128 operations of eps/2 at worst; about 10^4 that err at
//                                                    random, as sqrt(n) eps/2
//   100  times                                       IDA's own measure of times that are one
//   1000 solutions of small dense problems           some n^2 operations of eps/2 a row, n = 24: six contacts
//
// What has passed through a solve is known to the solve's backward error, not to these.
#pragma once

#include <limits>

namespace signorini::rounding {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double of_few = 4.0 * eps;
inline constexpr double of_many = 64.0 * eps;
inline constexpr double of_time = 100.0 * eps;
inline constexpr double of_elimination = 1e3 * eps;

}  // namespace signorini::rounding
