#include "contact/massless_slip.hpp"

#include <cmath>

#include "base/rounding.hpp"

namespace signorini {
namespace {

constexpr int most_steps =
    200;  // Newton steps: the first ones advance by v at least, the last ones converge quadratically

}  // namespace

double rate_of_saturation(const Friction& friction) {
  return -friction.rate_of_change() * std::log(saturated);
}

std::optional<double> massless_slip_rate(const Friction& friction, double pull, double damping,
                                         double pressed) {
  const double slow = friction.static_, fast = friction.kinetic, v = friction.rate_of_change();
  // Below slow |N|, friction continues as a straight line (contact/friction.cpp).
  if (pull <= slow * pressed) return (pull - slow * pressed) / (damping + (fast - slow) / v * pressed);
  if (!(damping > 0.0)) {
    const double rest = (fast * pressed - pull) / ((fast - slow) * pressed);
    if (!(rest > saturated)) return std::nullopt;
    return -v * std::log(rest);
  }
  // The residual is increasing and concave in x: started from the left, Newton steps never pass the root.
  double x = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const double fading = (fast - slow) * std::exp(-x / v) * pressed;
    const double step = (pull - damping * x - fast * pressed + fading) / (damping + fading / v);
    x += step;
    if (std::abs(step) <= rounding::of_few * (std::abs(x) + v)) break;
  }
  return x;
}

}  // namespace signorini
