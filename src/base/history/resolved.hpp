// resolved.hpp: a history as the clock of a run tells its times apart.
//
//   starts s_i, s_j of pieces with 0 <= s_j - s_i <= 100 eps (s_i + t_end)  ->  one at the last of them
//   starts in [0, 100 eps t_end]                                            ->  one at 0
//
// What lasts less is passed at once: engines cannot tell its steps apart, each in another way.
#pragma once

#include "signorini/history.hpp"

namespace signorini {

/// Numbers in [from, to) of starts that are one, the next group from `to` on.
[[nodiscard]] std::size_t end_of_instant(const History& f, std::size_t from, double t_end);
[[nodiscard]] History resolved(const History& f, double t_end);

}  // namespace signorini
