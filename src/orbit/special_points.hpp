// special_points.hpp: test functions of a branch of orbits, and their zeros between two of its points.
//
//   fold             t_s, the part of the branch's direction along the key
//   flip             1 + the smallest real multiplier
//   neimark-sacker   the largest magnitude of a complex pair - 1
//   branch point     the largest real multiplier - 1, if t_s keeps its sign
//
// Structural multipliers 1 (of families of orbits, and of a shift in time) are excluded.
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

/// A zero of a test function is accepted if the multiplier's distance from the unit circle, or |t_s|, is at most
/// this value. A function that jumps over zero, for instance where a complex pair becomes real, has no zero.
inline constexpr double location_tolerance = 1e-6;

/// Values of the test functions. ones: number of structural multipliers 1; along: t_s; error: error of a
/// multiplier's distance from the unit circle. A multiplier within this error is regarded as inside the
/// circle, so that rounding alone changes no sign.
[[nodiscard]] TestValues test_values(const Multipliers& all, std::size_t ones, double along, double error);

/// Zero of f in [0, 1] by the Illinois method (regula falsi). a = f(0) and b = f(1) must have opposite signs.
/// If f returns nullopt, its value is unknown, and the search ends with nullopt.
[[nodiscard]] std::optional<double> root_between(double a, double b,
                                                 const std::function<std::optional<double>(double)>& f);

}  // namespace signorini::orbit
