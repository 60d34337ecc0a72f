// root.hpp: downward zero crossing of a function, bracketed (GSL, Brent's method).
//
//   f(lo) > 0 >= f(hi):   t with f(t) = 0, lo and hi narrowed to `width`
#pragma once

#include <functional>

namespace signorini {

/// The root between lo and hi; f is evaluated at both ends first. Without a sign change: lo if f is not positive there,
/// else hi. Every f(t) must be finite.
[[nodiscard]] double root_between(const std::function<double(double)>& f, double lo, double hi, double width);

}  // namespace signorini
