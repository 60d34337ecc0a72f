// massless_slip.hpp: how fast a sliding point without mass slips where friction rises with the rate.
//
//   pull - c x = f(x) |N|,   f(x) = fast - (fast - slow) exp(-x / v)      x = s p', c: dashpot beside kt
//   c = 0:  x = -v ln m,   m = (fast |N| - pull) / ((fast - slow) |N|)
//
// T of the spring holds the point, so that friction tells its rate: the left side falls with x and the right side
// rises, hence x is unique. Without a dashpot there is none where the pull is what friction reaches at any rate;
// the point then follows at once. x < 0: the pull is below slow |N|, the point sticks. Units: x, v length/time.
#pragma once

#include <optional>

#include "signorini/scene.hpp"

namespace signorini {

/// Friction that is nearer to `fast` than this part of fast - slow is at it: a pull tells the rate no more. Chosen;
/// tests/unit/contact/massless_slip.cpp moves with it.
inline constexpr double saturated = 1e-8;

/// Beyond this rate friction is `fast`: -v ln(saturated).
[[nodiscard]] double rate_of_saturation(const Friction& friction);

/// pull: along the slip, at x = 0; pressed: |N| > 0; damping >= 0. Nothing: friction is at its greatest.
[[nodiscard]] std::optional<double> massless_slip_rate(const Friction& friction, double pull, double damping,
                                                       double pressed);

}  // namespace signorini
