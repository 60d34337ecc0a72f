// disturb.hpp: the same model, every datum off by about one rounding.
//
//   x -> x (1 + delta r),   delta = 1e-15,  |r| in [1/2, 1], the same r for M_ij and M_ji
//
// Of a reduced model the data are those of the structure: x^T K y of two shapes is off by what its terms are, which may
// cancel, so that stiffnesses and shapes are others (mixed_shapes.hpp).
// A static start follows its data, with friction as far as that holds below its limit (moved_start.hpp).
// What stays: times of breakpoints, the initial state of what touches, displacements of other static starts, gaps that are
// closed, and zeros. So laws, states at the start and symmetry of the matrices are those of the model. The same seed gives
// the same model.
#pragma once

#include <cstdint>

#include "signorini/model.hpp"

namespace signorini {

/// 1 or -1, by chance, the same for the same numbers.
[[nodiscard]] double sign_by_chance(std::uint64_t seed, std::uint64_t number);

[[nodiscard]] Model disturbed(const Model& model, std::uint64_t seed);

}  // namespace signorini
