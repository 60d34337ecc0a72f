// equilibrium.hpp: residual of the equation of motion.
//
//   r = M a + C v + K u + sum ( n N + t T ) - P(t)
#pragma once

#include "linear/structure.hpp"
#include "motion/point.hpp"

namespace signorini {

/// Greatest |r_i| at a point whose accelerations are known. Unit: force.
[[nodiscard]] double imbalance(const Model& model, const Structure& structure, const Forcing& forcing,
                               double t, const Point& point);

}  // namespace signorini
