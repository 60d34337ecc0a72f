// units.hpp: unit of an output.
//
//   N, V, T: force     M: force length     stress: force/length^2     gap, slip: length     loss: force length
//   motions: length or 1, over time once or twice     combination: unit of its terms times that of their factors
#pragma once

#include <optional>
#include <string_view>

#include "signorini/scene.hpp"

namespace signorini::scene {

[[nodiscard]] bool same_unit(const Unit& a, const Unit& b);
[[nodiscard]] Unit product_of_units(const Unit& a, const Unit& b);

/// Unit of an output. `all`: the outputs of the scene, at least those before this one.
[[nodiscard]] Unit unit_of_output(const OutputSpec& spec, const std::vector<OutputSpec>& all);
/// Unit of a combination's term, with its factor. The term's name must be known.
[[nodiscard]] Unit unit_of_term(const OutputTerm& term, const std::vector<OutputSpec>& all);

// Parses a unit as a scene writes it.
//
//   "1/m^2", "kN m/s", "s^2/t"     names of the scene's units, each with a power; one '/', all units after it in
//                                  the denominator
//
// The inverse is unit_text() (signorini/output.hpp).

/// nullopt: the text is not a unit. mass = force time^2 / length; "1" and "rad" are plain numbers.
[[nodiscard]] std::optional<Unit> unit_of_text(std::string_view text, const Units& names);

}  // namespace signorini::scene
