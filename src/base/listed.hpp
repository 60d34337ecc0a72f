// listed.hpp: lists names in a sentence.
//
//   listed({"A", "B", "C"}, 3)        "'A', 'B' and 'C'"
//   listed({"A", "B", "C", "D"}, 2)   "'A', 'B' and 2 more"
#pragma once

#include <string>
#include <vector>

namespace signorini {

/// The first `most` names, then the number of the others.
[[nodiscard]] std::string listed(const std::vector<std::string>& names, std::size_t most = 10);

/// Same for texts without additional quotes.
[[nodiscard]] std::string listed_plainly(const std::vector<std::string>& texts, std::size_t most = 10);

}  // namespace signorini
