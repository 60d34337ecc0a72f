// rescale.hpp: a model in other units of force, length and time.
//
//   u_i: length (translations) or none (rotations),   energy = force length
//   M_ij = energy time^2 / (u_i u_j),   C_ij = energy time / (u_i u_j),   K_ij = energy / (u_i u_j)
//
// By powers of two every number is exact, and so is the way back.
#pragma once

#include "scene/quantities.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// A history whose values have the unit `of`.
[[nodiscard]] History rescaled(History history, const Unit& of, const Factors& factors);

/// All numbers times the factors of their units; `unit` is divided by them, `machine` stays.
[[nodiscard]] Model rescaled(Model model, const Factors& factors);

}  // namespace signorini
