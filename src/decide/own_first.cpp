#include "decide/own_first.hpp"

#include <algorithm>

namespace signorini {

void leave_pushed_for_later(const Model& model, const std::vector<bool>& visited,
                            const std::vector<std::size_t>& block_of, std::vector<Failure>& failed) {
  const auto does_not_stick = [&](const Failure& f) {
    const Contact& contact = model.contacts[f.contact];
    return visited[f.contact] && is_friction_limit(f.guard) && f.sign.order == 0 &&
           contact.sticks_rigidly() && !contact.takes_impulses();
  };
  std::vector<std::size_t> blocks;
  for (const Failure& f : failed)
    if (does_not_stick(f)) blocks.push_back(block_of[f.contact]);
  std::erase_if(failed, [&](const Failure& f) {
    return !visited[f.contact] && f.sign.order == 0 &&
           std::find(blocks.begin(), blocks.end(), block_of[f.contact]) != blocks.end();
  });
}

}  // namespace signorini
