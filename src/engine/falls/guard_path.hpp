// guard_path.hpp: a guard along one step, from its values and rates at both ends.
//
//   p(x) = Hermite's cubic through g0, h g0', g1, h g1',   0 <= x <= 1
//   x*   = g0/(g0 - g1)                                    the paper's interpolation, (8) to (10)
//
// For the guard T_U - s T the linear interpolation reads t = t0 + dt (s T_U0 - T0)/((T1 - T0) - s (T_U1 - T_U0)). If
// the equations yield no rate, the rate of the parabola through the last three values is used.
#pragma once

#include <optional>

namespace signorini {

/// A guard at the ends of a step of length h.
struct GuardPath {
  double g0 = 0.0, g1 = 0.0;  ///< values
  double r0 = 0.0, r1 = 0.0;  ///< rates times h

  /// Place where the straight line between the ends reaches zero; g0 > 0 >= g1.
  [[nodiscard]] double linear() const { return g0 / (g0 - g1); }
  struct Fall {
    double x = 0.0, slope = 0.0;  ///< slope: derivative by x
  };
  /// Place where the cubic reaches zero, g0 > 0 >= g1. nullopt: the cubic rises there, or is not a number.
  [[nodiscard]] std::optional<Fall> fall() const;
  /// For a path that is positive at both ends: the place of its least value inside, if that value is not positive.
  [[nodiscard]] std::optional<double> dip() const;
};

/// Sets the rates from the value `before` at a distance h_before ahead of the step (0: a straight line).
void rates_from_values(GuardPath& path, double h, double before, double h_before);

}  // namespace signorini
