// settle_guard.hpp: where on a step a guard that is a polynomial and a ripple may fall, and where it does.
//
//   g(t + h x) = p(x) + ripple,  |ripple| <= R,  |p's own error| <= slack
//   p > R + slack                     it does not
//   p falls through +-(R + slack) within a stretch on which p' < -R' h:   once; the closed form says where
//   else                              nothing is known beyond the place where p - 2 (R + slack) falls
//
// A guard that starts at zero is held by its first derivative that is not: p is that derivative then.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/exact/modal/modal_flow.hpp"
#include "engine/falls/arming.hpp"

namespace signorini {

/// A guard on a step, x in [0, 1].
struct GuardOnStep {
  std::vector<double> p;  ///< coefficients; of derivative number `leading` by time, where that is not 0
  double slack = 0.0, ripple = 0.0, ripple_rate = 0.0;  ///< of g, g and g' (by time), or of that derivative
  double noise = 0.0;
  std::size_t leading = 0;
  bool armed = false;  ///< it was clearly positive
};

/// Coefficients of derivative number m by time of a polynomial in t / h.
[[nodiscard]] std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h);

/// event: the place of the first fall so far; limit: the place up to which nothing falls. value_at(x): the guard
/// in closed form. False: what the guard's derivatives at the start said is doubted from now on.
[[nodiscard]] bool settle_guard(GuardOnStep& guard, std::size_t slot, double h,
                                const std::function<double(double)>& value_at, Arming& arming,
                                Passage& passage, double& limit, double& event);

/// What the step comes to once its guards are settled, as far as `limit` and `event` let it; none: it is to be tried
/// again, with all modes taken as slow (`full`) unless a guard is newly doubted. h: length of the step.
[[nodiscard]] std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event,
                                                 double h, bool& full);

/// The part of [0, 1] on which sign a(x x_end) + above > 0; p: room for degree + 1 numbers.
[[nodiscard]] double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                                 std::vector<double>& p);

}  // namespace signorini
