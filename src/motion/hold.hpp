// hold.hpp: removes the drift from the constraints of a contact state.
//
//   n . u + g0 = 0,  n . v = 0     at closed rigid contacts
//   t . v = s'                     at contacts that stick without tangential stiffness
#pragma once

#include "motion/forcing.hpp"
#include "motion/mode_system.hpp"

namespace signorini {

/// Changes u and v as little as possible, in the norm of M, so that they satisfy the constraints of the contact state
/// at t. Returns the impulses along n and t of the contacts that change v, slots like those of forces; empty: none.
Eigen::VectorXd hold(const Model& model, const ModeSystem& system, const Forcing& forcing, double t,
                     Vector& u, Vector& v);

}  // namespace signorini
