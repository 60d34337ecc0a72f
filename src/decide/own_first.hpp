// own_first.hpp: order of state changes if several contacts change at one instant.
//
//   p' = 0: it stops   ->   |T| <= f|N| in stick?   no: it slips, in the other direction or in the same
//
// While a stopped contact is tried as sticking, it pulls at others with a force that is later found not to exist.
// Contacts that only this force pushes beyond a limit have no reason to change: they are decided after the state of the
// stopped contact is known.
#pragma once

#include <vector>

#include "decide/guard_signs.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// If a contact that was decided before is beyond the limit of rigid friction, removes failures of other contacts of
/// its block that were not decided before: failures of values, not of rates. visited: one entry per contact; block_of:
/// its block.
void leave_pushed_for_later(const Model& model, const std::vector<bool>& visited,
                            const std::vector<std::size_t>& block_of, std::vector<Failure>& failed);

}  // namespace signorini
