// same_structure.hpp: do two scenes, with all defaults filled in, describe the same structure?
//
//   nodes, lines, sections, members, masses, springs, damping, supports, contacts, stops, reduction, matrices, gravity,
//   run.geometric
//
// Excitation is ignored, because a continued run may have another one: motions of supports and surfaces, normal forces
// of sliders, temperatures and initial strains of members, and the initial shear of friction.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace signorini {

[[nodiscard]] bool same_units(const toml::table& a, const toml::table& b);
/// "kN, t, m, s"
[[nodiscard]] std::string units_of(const toml::table& scene);
/// The tables with different content, in the order above.
[[nodiscard]] std::vector<std::string> differing_structure(const toml::table& a, const toml::table& b);

}  // namespace signorini
