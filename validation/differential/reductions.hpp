// reductions.hpp: what may be taken away from a scene file, one kind a function.
//
// Each returns changed copies of the table, the boldest first. A copy may be a wrong scene.
#pragma once

#include <toml++/toml.h>

#include <vector>

namespace signorini::differential {

using Tables = std::vector<toml::table>;

/// Without one load, contact, spring, mass, support or member; without ground motion or damping.
[[nodiscard]] Tables without_parts(const toml::table& scene);
/// Matrix scenes: without one degree of freedom (dofs must have their default names).
[[nodiscard]] Tables without_dofs(const toml::table& scene);
/// Contacts and loads without one of the keys that have a default; tables { ... } as single numbers.
[[nodiscard]] Tables without_options(const toml::table& scene);
/// A shorter run, with as many rows.
[[nodiscard]] Tables shorter(const toml::table& scene);
/// Matrix scenes: all off one diagonal as zero, then pairs as zero or rounded: a matrix stays symmetric.
[[nodiscard]] Tables plainer_pairs(const toml::table& scene);
/// One number as zero, or rounded to one, two or three digits.
[[nodiscard]] Tables plainer_numbers(const toml::table& scene);

}  // namespace signorini::differential
