// same_structure.hpp: do two scenes, with all defaults filled in, describe one structure?
//
//   nodes, lines, sections, members, masses, springs, damping, supports, contacts, stops, reduction, matrices, gravity,
//   run.geometric
//
// without what drives them, which may be another in a run that goes on: motions of supports and surfaces,
// compressions, temperatures and initial strains of members, and friction's initial shear.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace signorini {

[[nodiscard]] bool same_units(const toml::table& a, const toml::table& b);
/// "kN, t, m, s"
[[nodiscard]] std::string units_of(const toml::table& scene);
/// The tables in which they differ, in the order above.
[[nodiscard]] std::vector<std::string> differing_structure(const toml::table& a, const toml::table& b);

}  // namespace signorini
