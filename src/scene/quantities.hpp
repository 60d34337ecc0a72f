// quantities.hpp: every number of a scene, with its unit; and the scene in other units.
//
//   [x] = force^a length^b time^c,      mass = force time^2 / length
//
//   Scene in_millimetres = rescaled(scene, {1.0, 1000.0, 1.0});   // the same motion, lengths times 1000
//
// Displacements in scenes of [matrices] have unknown units; there the factor for lengths must be 1.
#pragma once

#include <functional>

#include "base/unit.hpp"
#include "signorini/scene.hpp"

namespace signorini::scene {

/// Factor by which a quantity of this unit is multiplied.
[[nodiscard]] double factor_of(const Unit& unit, const Factors& factors);
/// 1 / factors; exact for powers of two.
[[nodiscard]] Factors inverse(const Factors& factors);

/// Calls `visit` for all numbers that describe the motion, in an order that depends on the scene's structure alone. Not
/// visited: coefficients of friction and restitution, unit vectors, tolerances without a unit, relaxation and counts.
void visit_quantities(Scene& scene, const std::function<void(double&, const Unit&)>& visit);

/// Calls `visit` for all numbers of a history whose values have the unit `of`.
void visit_numbers(History& history, const Unit& of, const std::function<void(double&, const Unit&)>& visit);

/// All quantities times the factors of their units; Scene::resolved stays unchanged. Exact if the factors are powers of two and
/// no product exceeds the range of doubles.
[[nodiscard]] Scene rescaled(Scene scene, const Factors& factors);
/// The settings of a run times the factors of their units.
[[nodiscard]] RunSpec rescaled(RunSpec run, const Factors& factors);

}  // namespace signorini::scene
