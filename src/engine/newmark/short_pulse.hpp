// short_pulse.hpp: steps of a segment that is hardly longer than dt, so that its loads transfer their impulses.
//
//   J = int f dt ~ T(1024),   T(n) = h sum'' f(t_i): impulse in n steps of average acceleration
//   dt    where |T - J| <= int |f| / 16 of its own steps
//   h     else: the segment in n = 2^k parts, the fewest with |T(n) - J| <= 1e-4 int |f|
//
// A half sine is zero where it begins and ends: one step from end to end would miss it entirely, two steps lose a
// fifth. A dt that is short enough for a load is kept, also for tables: a step ends at each row, beyond which no curve
// goes.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Longer segments use dt, which integrates half waves of such a length to within a 200th.
inline constexpr double short_of_steps = 16.0;

/// Length of the steps from `begin` to `end`, at most dt; no history breaks between them. Loads and compressions are
/// considered.
[[nodiscard]] double step_within(const Model& model, double begin, double end, double dt);

}  // namespace signorini
