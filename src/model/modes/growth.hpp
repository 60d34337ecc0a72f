// growth.hpp: how fast an unstable structure runs away.
//
//   K x = -sigma^2 M x,   u ~ exp(sigma t)
//
// Only matrices from elsewhere can have such a K, and frozen forces (run.geometric): no member, spring or contact has
// negative energy.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini {

struct Growth {
  double rate = 0.0;  ///< sigma; infinite where the motion has no mass
  Vector motion;
};

/// Strain energy below zero, beyond the roundoff of evaluating it.
[[nodiscard]] bool has_negative_energy(const SparseMatrix& k, const Vector& motion);

/// The fastest growing motion; nothing when no motion has negative energy. Damping left out.
[[nodiscard]] std::optional<Growth> fastest_growth(const SparseMatrix& k, const SparseMatrix& mass);

}  // namespace signorini
