// disturb.hpp: a perturbed copy of a model: every datum is changed by about one rounding.
//
//   x -> x (1 + delta r),   delta = 1e-15,  |r| in [1/2, 1], the same r for M_ij and M_ji
//
// For a reduced model the perturbed data are those of the structure: x^T K y of two shapes changes by the rounding of
// its terms, which may cancel, so stiffnesses and shapes change (mixed_shapes.hpp). A static start follows its data,
// with friction as long as it stays below its limit (moved_start.hpp). Unchanged are: times of breakpoints, the initial
// state of touching contacts, displacements of other static starts, closed gaps, and zeros. So laws, states at the
// start and symmetry of the matrices are those of the model. The same seed gives the same model.
#pragma once

#include <cstdint>

#include "signorini/model.hpp"

namespace signorini {

/// Pseudo-random 1 or -1, the same for the same numbers.
[[nodiscard]] double sign_by_chance(std::uint64_t seed, std::uint64_t number);

[[nodiscard]] Model disturbed(const Model& model, std::uint64_t seed);

}  // namespace signorini
