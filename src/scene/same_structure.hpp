// same_structure.hpp: do two scenes, with all defaults filled in, describe one structure?
//
//   nodes, lines, sections, members, masses, springs, damping, supports, contacts, stops, reduction, matrices, gravity
//
// without what moves supports, contacts and surfaces, friction's initial shear among it, which may be another in a run
// that goes on.
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
