// resolved.hpp: merges starts of pieces that the time resolution of a run cannot separate.
//
//   starts s_i, s_j of pieces with 0 <= s_j - s_i <= 100 eps (s_i + t_end)  ->  one at the last of them
//   starts in [0, 100 eps t_end]                                            ->  one at 0
//
// Shorter pieces are skipped, because each engine would treat their unresolved steps differently.
#pragma once

#include "signorini/history.hpp"

namespace signorini {

/// End of the group of starts, beginning with `from`, that are one instant: indices [from, result).
[[nodiscard]] std::size_t end_of_instant(const History& f, std::size_t from, double t_end);
[[nodiscard]] History resolved(const History& f, double t_end);

}  // namespace signorini
