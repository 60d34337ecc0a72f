#include "engine/falls/arming.hpp"

#include <algorithm>

namespace signorini {

void Arming::start(const std::vector<GuardStart>& guards) {
  guards_.resize(guards.size());
  for (std::size_t slot = 0; slot < guards.size(); ++slot) {
    const GuardStart& guard = guards[slot];
    if (guard.kind == Guard::none)
      guards_[slot] = {Standing::idle, 0};
    else if (guard.at_zero)
      guards_[slot] = {Standing::waiting, static_cast<std::size_t>(std::max(guard.leading, 0))};
    else
      guards_[slot] = {Standing::armed, 0};
  }
}

void Arming::see(std::size_t slot, double value, double level) {
  if (guards_[slot].standing != Standing::waiting) return;
  guards_[slot] = {value > level ? Standing::armed : Standing::waiting, 0};
}

}  // namespace signorini
