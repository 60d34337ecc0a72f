// suggest.hpp: what did the user mean?
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

/// The known name nearest to the given one, if it is near enough to be a slip of the pen; else empty.
[[nodiscard]] std::string nearest(std::string_view given, const std::vector<std::string>& known);

/// "; did you mean \"friction\"?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

/// The end of a message: the nearest name, or else the known ones (a few of them).
[[nodiscard]] std::string suggestion(std::string_view given, const std::vector<std::string>& known);

}  // namespace signorini
