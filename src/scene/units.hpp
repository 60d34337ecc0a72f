// units.hpp: unit of an output.
//
//   N, V, T: force     M: force length     stress: force/length^2     gap, slip: length     loss: force length
//   displacement: length, or 1 for a rotation; velocity: divided by time; acceleration: divided by time^2
//   combination: unit of an output times unit of its factor
#pragma once

#include <optional>
#include <string_view>

#include "signorini/scene.hpp"

namespace signorini::scene {

[[nodiscard]] bool same_unit(const Unit& a, const Unit& b);
[[nodiscard]] Unit product_of_units(const Unit& a, const Unit& b);

/// Unit of an output. `all`: the outputs of the scene, at least those before this one.
[[nodiscard]] Unit unit_of_output(const OutputSpec& spec, const std::vector<OutputSpec>& all);
/// Unit of a term of a combination: unit of its output, which must be in `all`, times unit of its factor.
[[nodiscard]] Unit unit_of_term(const OutputTerm& term, const std::vector<OutputSpec>& all);

// Parses a unit as a scene writes it.
//
//   "1/m^2", "kN m/s", "s^2/t"     names of the scene's units, each with a power; one '/', all units after it in
//                                  the denominator
//
// The inverse is unit_text() (signorini/output.hpp).

/// Unit for a text; nullopt if the text is not a unit. mass = force time^2 / length; "1" and "rad" are plain numbers.
[[nodiscard]] std::optional<Unit> unit_of_text(std::string_view text, const Units& names);

}  // namespace signorini::scene
