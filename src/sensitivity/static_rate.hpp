// static_rate.hpp: derivative of a static start without friction with respect to a parameter.
//
//   (K + sum_closed kn n n^T) w = P_p - K_p u0 - sum_closed ( n_p N + n N_p ),   N_p = kn_p g + kn (g0_p + n_p . u0)
//   rigid contacts: K w + sum n N_p = P_p - K_p u0 - sum n_p N,   n . w = -g0_p - n_p . u0
//
// A difference of two equilibria would have the rounding errors of their solves divided by the step; this derivative has the
// rounding errors of one solve.
//
// Contacts share free motions Z so that they slip least (model/statics/free_motions.hpp): Z^T f = 0 with
//
//   f = sum |N_k| s_k t_k,   s_k = t_k . u0
//
// Z changes with K. With the displacements y and the forces G on closed contacts under the load -f,
//
//   Z^T ( f_p + K_p y + sum n_p G ) = 0,   f_p = sum |N_k|_p s_k t_k + |N_k| s_k t_k,p + |N_k| (t_k,p . u0 + t_k . w) t_k
//
// This follows from the conditions of the least slips, f + K y + sum n G = 0, whose derivative Z^T multiplies.
#pragma once

#include <optional>

#include "sensitivity/model_derivative.hpp"
#include "signorini/model.hpp"

namespace signorini::sensitivity {

/// w for a model with a frictionless static start; nullopt: a free motion moves no contact that has a force.
[[nodiscard]] std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative);

}  // namespace signorini::sensitivity
