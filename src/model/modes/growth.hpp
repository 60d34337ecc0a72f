// growth.hpp: growth rate of an unstable structure.
//
//   K x = -sigma^2 M x,   u ~ exp(sigma t)
//
// Only matrices from files and frozen forces (run.geometric) can produce such a K; members, springs and contacts have
// no negative energy.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini {

struct Growth {
  double rate = 0.0;  ///< sigma; infinite if the motion has no mass
  Vector motion;
};

/// True if the strain energy is negative beyond the rounding of its evaluation.
[[nodiscard]] bool has_negative_energy(const SparseMatrix& k, const Vector& motion);

/// The fastest growing motion; nullopt if no motion has negative energy. Damping is neglected.
[[nodiscard]] std::optional<Growth> fastest_growth(const SparseMatrix& k, const SparseMatrix& mass);

}  // namespace signorini
