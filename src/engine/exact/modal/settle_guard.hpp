// settle_guard.hpp: possible and certain zeros on a step of a guard that is a polynomial plus a ripple.
//
//   g(t + h x) = p(x) + ripple,  |ripple| <= R,  |p's own error| <= slack
//   p > R + slack                     no zero
//   p decreases through +-(R + slack) within a stretch on which p' < -R' h:   one zero, located by the closed form
//   otherwise                         undecided beyond the zero of p - 2 (R + slack)
//
// A guard that starts at zero is represented by its first nonzero derivative: p is that derivative then.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/exact/modal/modal_flow.hpp"
#include "engine/falls/arming.hpp"

namespace signorini {

/// A guard on a step, x in [0, 1].
struct GuardOnStep {
  std::vector<double> p;  ///< coefficients; of time derivative number `leading` if that is not 0
  double slack = 0.0, ripple = 0.0, ripple_rate = 0.0;  ///< bounds for g, g, g' (by time), or for p
  double noise = 0.0;
  std::size_t leading = 0;
  bool armed = false;  ///< the guard was clearly positive
};

/// Coefficients of time derivative number m of a polynomial in t / h.
[[nodiscard]] std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h);

/// event: place of the first zero so far; limit: place up to which no guard reaches zero. value_at(x): the guard in
/// closed form. False: the prediction by the guard's derivatives at the start is refuted and no longer used.
[[nodiscard]] bool settle_guard(GuardOnStep& guard, std::size_t slot, double h,
                                const std::function<double(double)>& value_at, Arming& arming,
                                Passage& passage, double& limit, double& event);

/// Passage of the step once its guards are settled, limited by `limit` and `event`; nullopt: the step has to be
/// repeated, with all modes treated as slow (`full`) unless a guard's start has just been refuted. h: length of the
/// step.
[[nodiscard]] std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event,
                                                 double h, bool& full);

/// The part of [0, 1] on which sign a(x x_end) + above > 0; p: scratch for degree + 1 numbers.
[[nodiscard]] double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                                 std::vector<double>& p);

}  // namespace signorini
