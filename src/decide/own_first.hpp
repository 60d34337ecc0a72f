// own_first.hpp: in which order contacts change their states where several do at one instant.
//
//   p' = 0: it comes to rest   ->   |T| <= f|N| in stick?   no: it slips the other way, or on
//
// While one that has come to rest is tried as sticking it pulls at others, with a force that it turns out not to have. What
// only this pushes beyond a limit has no reason of its own to change: it is asked again when the other's state is known.
#pragma once

#include <vector>

#include "decide/guard_signs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Where a contact that was asked before lies beyond the limit of rigid friction: failures of others of its block that were
/// not, of values and not of rates, are dropped. visited: one a contact; block_of: its block.
void leave_pushed_for_later(const Model& model, const std::vector<bool>& visited,
                            const std::vector<std::size_t>& block_of, std::vector<Failure>& failed);

}  // namespace signorini
