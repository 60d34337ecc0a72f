// massless_slip.hpp: slip rate of a massless sliding point if friction rises with the rate.
//
//   pull - c x = f(x) |N|,   f(x) = fast - (fast - slow) exp(-x / v)      x = s p', c: dashpot beside kt
//   c = 0:  x = -v ln m,   m = (fast |N| - pull) / ((fast - slow) |N|)
//
// The spring force T acts on the point, so that friction determines its rate: the left side decreases with x and the
// right side increases, hence x is unique. Without a dashpot there is no solution if the pull reaches the limit of
// friction at infinite rate; the point then follows instantaneously. x < 0: the pull is below slow |N|, the point
// sticks. Units: x, v length/time.
#pragma once

#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Friction counts as `fast` if it differs from it by less than this fraction of fast - slow: the pull then no longer
/// determines the rate. Chosen value; tests/unit/contact/massless_slip.cpp depends on it.
inline constexpr double saturated = 1e-8;

/// Rate beyond which friction counts as `fast`: -v ln(saturated).
[[nodiscard]] double rate_of_saturation(const Friction& friction);

/// Slip rate x. pull: along the slip, at x = 0; pressed: |N| > 0; damping >= 0. nullopt: friction is at its greatest
/// value.
[[nodiscard]] std::optional<double> massless_slip_rate(const Friction& friction, double pull, double damping,
                                                       double pressed);

}  // namespace signorini
