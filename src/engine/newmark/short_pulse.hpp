// short_pulse.hpp: steps of a stretch that is hardly longer than dt, so that its loads pass their impulses on.
//
//   J = int f dt ~ T(1024),   T(n) = h sum'' f(t_i): what n steps of average acceleration make of it
//   dt    where |T - J| <= int |f| / 16 of its own steps
//   h     else: the stretch in n = 2^k parts, the fewest with |T(n) - J| <= 1e-4 int |f|
//
// A half sine is zero where it begins and ends: one step from end to end would see nothing of it, two a fifth too little.
// dt that is short enough for a load is left alone, and so are tables: a step ends at each row, beyond which no curve goes.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Stretches that are longer are left to dt, which sees the half waves of such a length within a 200th.
inline constexpr double short_of_steps = 16.0;

/// The length of the steps from `begin` to `end`, between which no history breaks, at most dt. Loads and compressions
/// count.
[[nodiscard]] double step_within(const Model& model, double begin, double end, double dt);

}  // namespace signorini
