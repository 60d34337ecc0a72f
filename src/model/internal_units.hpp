// internal_units.hpp: units of force, length and time for internal computation.
//
//   length = 2^i ~ extent of the structure       (without extent: a gap, an initial displacement, a static response)
//   time   = 2^j ~ sqrt(mass / stiffness)        largest mass and stiffness (no stiffness: a quarter of the run)
//   force  = 2^k ~ mass length / time^2
//
// Units are powers of two times the scene's units, determined by exponents alone. If the scene's units change
// by powers of two, the internal numbers and all results are bitwise the same. [matrices]: length = 1. If a
// unit were above 2^120 or below 2^-120 of the scene's unit, the scene's units are used.
#pragma once

#include "scene/quantities.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::model {

/// One internal unit of each kind, in the scene's units.
[[nodiscard]] Factors find_internal_units(const Scene& scene);

// A model in other units of force, length and time.
//
//   u_i: length (translations) or none (rotations),   energy = force length
//   M_ij = energy time^2 / (u_i u_j),   C_ij = energy time / (u_i u_j),   K_ij = energy / (u_i u_j)
//
// With powers of two the conversion is exact, and so is its inverse.

/// Converts the times and the values of a history; the values have the unit `of`.
[[nodiscard]] History rescaled(History history, const Unit& of, const Factors& factors);

/// Multiplies all numbers of the model by the factors of their units, divides Model::unit by the factors, and
/// leaves Model::internal_units unchanged.
[[nodiscard]] Model rescaled(Model model, const Factors& factors);

// Computed values in the scene's units, for messages.
//
//   value in scene units = value * factor of its unit          Model::unit; for complete results: run/scene_units.hpp

[[nodiscard]] inline double in_scene_units(const Model& model, double value, const Unit& of) {
  return value * scene::factor_of(of, model.unit);
}
[[nodiscard]] inline double time_in_scene_units(const Model& model, double t) {
  return in_scene_units(model, t, unit::time);
}

}  // namespace signorini::model
