// static_rates.hpp: derivative of the static start by a parameter.
//
//   (K + sum_closed kn n n^T) w = P_p - K_p u0 - sum_closed ( n_p N + n N_p ),   N_p = kn_p g + kn (g0_p + n_p . u0)
//   rigid ones: K w + sum n N_p = P_p - K_p u0 - sum n_p N,   n . w = -g0_p - n_p . u0
//   t_h . w = -t_h,p . u0 at contacts that hold a free motion
//
// A difference of two equilibria has the rounding of their solves divided by the step; this has that of one solve.
#pragma once

#include <optional>

#include "sensitivity/model_derivative.hpp"

namespace signorini {

/// model: with a frictionless static start. nullopt if its matrix remains singular.
[[nodiscard]] std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative);

}  // namespace signorini
