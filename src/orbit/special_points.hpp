// special_points.hpp: test functions of a branch of orbits, and their zeros between two of its points.
//
//   fold             t_s, the part of the branch's direction along the key
//   flip             1 + the smallest real multiplier
//   neimark-sacker   the largest magnitude of a pair - 1
//   branch point     the largest real multiplier - 1, where t_s keeps its sign
//
// The multipliers 1 of families and of time are excluded.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "orbit/multipliers.hpp"

namespace signorini::orbit {

struct TestValues {
  double fold = 1.0, flip = 1.0, neimark_sacker = -1.0, branch = -1.0;
};

struct SpecialKind {
  const char* name;
  double TestValues::*value;
};
inline constexpr std::array special_kinds{SpecialKind{"fold", &TestValues::fold},
                                          SpecialKind{"flip", &TestValues::flip},
                                          SpecialKind{"neimark-sacker", &TestValues::neimark_sacker},
                                          SpecialKind{"branch point", &TestValues::branch}};

/// Limit of a multiplier's distance from the unit circle, or of |t_s|, for a located zero of a test function. A
/// function that jumps over zero, as where a pair meets on the real axis, has no zero.
inline constexpr double location_tolerance = 1e-6;

/// Values of the test functions. ones: number of structural multipliers 1; along: t_s; error: of a
/// multiplier's distance from the unit circle. Multipliers within this error count as inside, so that
/// rounding alone changes no sign.
[[nodiscard]] TestValues test_values(const Multipliers& all, std::size_t ones, double along, double error);

/// Zero of f, with values a at 0 and b at 1 of opposite signs, by the Illinois method (regula falsi). f returns nullopt
/// for an unknown value, which ends the search.
[[nodiscard]] std::optional<double> root_between(double a, double b,
                                                 const std::function<std::optional<double>(double)>& f);

}  // namespace signorini::orbit
