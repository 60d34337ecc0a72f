// static_rates.hpp: how the static start moves with a parameter.
//
//   (K + sum_closed kn n n^T) w = P_p - K_p u0 - sum_closed ( n_p N + n N_p ),   N_p = kn_p g + kn (g0_p +
//   n_p . u0) rigid ones: K w + sum n N_p = P_p - K_p u0 - sum n_p N,   n . w = -g0_p - n_p . u0 t_h . w =
//   -t_h,p . u0 at what holds a free motion
//
// Differences of two equilibria have the rounding of their solves over the step; this has that of one solve.
#pragma once

#include <optional>

#include "sensitivity/model_derivative.hpp"

namespace signorini {

/// model: with a frictionless static start. Nothing where its matrix stays singular.
[[nodiscard]] std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative);

}  // namespace signorini
