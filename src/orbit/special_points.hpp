// special_points.hpp: test functions of a branch of orbits, and their zeros between two of its points.
//
//   fold             t_s, the part of the branch's direction along the key
//   flip             1 + the least real multiplier
//   neimark-sacker   the greatest magnitude of a pair - 1
//   branch point     the greatest real multiplier - 1, where t_s keeps its sign
//
// Multipliers are those without the ones of families and of time.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "orbit/multipliers.hpp"

namespace signorini {

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

/// A multiplier on the unit circle, |t_s|: a zero of a test function that is no more than this was located. One that jumps
/// over zero, as where a pair meets on the real axis, is none.
inline constexpr double located_to = 1e-6;

/// ones: multipliers that are 1 for reasons of their own; along: t_s; error: of a multiplier's distance from the unit circle.
/// Multipliers on the circle within it count as inside: rounding alone changes no sign.
[[nodiscard]] TestValues test_values(const Multipliers& all, std::size_t ones, double along, double error);

/// Where f, of values a at 0 and b at 1 of opposite signs, is zero: the rule of false position, by Illinois. f: nothing
/// where it is not known, which ends the search.
[[nodiscard]] std::optional<double> root_between(double a, double b,
                                                 const std::function<std::optional<double>(double)>& f);

}  // namespace signorini
