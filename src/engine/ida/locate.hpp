// locate.hpp: the time at which a guard reaches zero, to the resolution of time.
//
//   G(t) = guard(u(t), v(t), forces consistent with u(t), v(t) by the equations of the contact state) = 0
//
// A root of the interpolated unknowns satisfies the equations of the contact state only to the integrator's tolerance;
// the state decision needs a time at which its own forces are at their limit, so the root is refined with forces
// recomputed from the interpolated u and v.
#pragma once

#include "engine/ida/bdf_integrator.hpp"
#include "motion/consistent.hpp"

namespace signorini {

/// Refines `time`, a root of guard `slot` found on [begin, end] of the last step; returns it unchanged if the
/// recomputed guard does not cross zero there. Brackets by doubling, then Brent's method (GSL).
[[nodiscard]] double locate(BdfIntegrator& bdf, ConsistentMotion& consistent, const Segment& segment,
                            const Model& model, std::size_t slot, double begin, double end, double time,
                            double resolution);

}  // namespace signorini
