// guard_path.hpp: a guard along one step, from its values and rates at both ends.
//
//   p(x) = Hermite's cubic through g0, h g0', g1, h g1',   0 <= x <= 1
//   x*   = g0/(g0 - g1)                                    the paper's interpolation, (8) to (10)
//
// For the guard T_U - s T the latter reads t = t0 + dt (s T_U0 - T0)/((T1 - T0) - s (T_U1 - T_U0)).
// Where the equations do not yield a rate it is that of the parabola through the last three values.
#pragma once

#include <optional>

namespace signorini {

/// A guard at the ends of a step of length h.
struct GuardPath {
  double g0 = 0.0, g1 = 0.0;  ///< values
  double r0 = 0.0, r1 = 0.0;  ///< rates times h

  /// Where the straight line between the ends falls to zero; g0 > 0 >= g1.
  [[nodiscard]] double linear() const { return g0 / (g0 - g1); }
  struct Fall {
    double x = 0.0, slope = 0.0;  ///< slope: by x
  };
  /// Where the cubic falls to zero, g0 > 0 >= g1. Nothing: it rises there, or is no number.
  [[nodiscard]] std::optional<Fall> fall() const;
  /// Positive at both ends: the place of its least value inside, if that is not positive.
  [[nodiscard]] std::optional<double> dip() const;
};

/// Sets the rates from the value `before` at a distance h_before ahead of the step (0: a straight line).
void rates_from_values(GuardPath& path, double h, double before, double h_before);

}  // namespace signorini
