// breakpoints.hpp: where the forcing of a model is not smooth; integrators stop there.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Breakpoints of all forcing in (0, t_end), ascending; `jump` where any value jumps. Those that the clock
/// cannot tell apart are one, at the last of their times: every history is on its next piece there. Where one
/// history has several of them, its value jumps if they leave it another.
[[nodiscard]] std::vector<Breakpoint> breakpoints(const Model& model, double t_end);

}  // namespace signorini
