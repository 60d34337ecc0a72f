// rayleigh.hpp: is a damping matrix from a file alpha M + beta K?
//
//   | C - alpha M - beta K |_ij <= 1e-9 ( |C| + |alpha M| + |beta K| )_ij   for all ij,   alpha, beta >= 0
//
// 1e-9: programs write matrices with at least ten digits. A reduced model then damps its modes by alpha and beta. With
// C itself its static shapes would have dampers with time constants far below those of the modes.
#pragma once

#include <optional>

#include "signorini/model.hpp"

namespace signorini {

struct RayleighFactors {
  double alpha = 0.0;  ///< 1/time
  double beta = 0.0;   ///< time
};

/// All matrices symmetric, of one size. nullopt: C is not of that form, or zero.
[[nodiscard]] std::optional<RayleighFactors> rayleigh_factors(const SparseMatrix& damping,
                                                              const SparseMatrix& mass,
                                                              const SparseMatrix& stiffness);

}  // namespace signorini
