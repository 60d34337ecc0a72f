// suggest.hpp: suggests known names for a misspelt one.
//
//   suggestion("frictoin", {"friction", "gap"}) == "; did you mean \"friction\"?"
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to the given one, if it is near enough to be a typing error; else empty.
[[nodiscard]] std::string nearest(std::string_view given, const std::vector<std::string>& known);

/// "; did you mean \"friction\"?", or "".
[[nodiscard]] std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

/// End of a message: the nearest name, or else some of the known ones.
[[nodiscard]] std::string suggestion(std::string_view given, const std::vector<std::string>& known);

}  // namespace signorini
