// rescale.hpp: a model in other units of force, length and time.
//
//   u_i: length (translations) or none (rotations),   energy = force length
//   M_ij = energy time^2 / (u_i u_j),   C_ij = energy time / (u_i u_j),   K_ij = energy / (u_i u_j)
//
// With powers of two the conversion is exact, and so is its inverse.
#pragma once

#include "scene/quantities.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A history whose values have the unit `of`.
[[nodiscard]] History rescaled(History history, const Unit& of, const Factors& factors);

/// Multiplies all numbers by the factors of their units; `unit` is divided by them, `machine` is unchanged.
[[nodiscard]] Model rescaled(Model model, const Factors& factors);

}  // namespace signorini
