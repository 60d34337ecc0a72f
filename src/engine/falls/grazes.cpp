#include "engine/falls/grazes.hpp"

#include <algorithm>

namespace signorini {
namespace {
// Samples of a step's polynomial: it has at most five turning points, and is known to a tolerance only.
constexpr int looks = 8;
}  // namespace

void Grazes::start(const std::vector<GuardStart>& guards, const std::vector<double>& levels) {
  guards_.assign(guards.size(), Guarded{});
  for (std::size_t slot = 0; slot < guards.size(); ++slot) {
    guards_[slot].guard = guards[slot].kind;
    guards_[slot].level = levels[slot];
    guards_[slot].dip = dip_of_level * levels[slot] + guards[slot].noise;
  }
}

void Grazes::see(const StepHistory& history, double limit) {
  for (std::size_t slot = 0; slot < guards_.size(); ++slot) {
    Guarded& guard = guards_[slot];
    if (guard.guard == Guard::none) continue;
    // If the last value is twice the bend that the older values can cause, the guard stays above half of it on the
    // step.
    if (guard.high == guard.level && !guard.low && history.clearly_positive(slot) &&
        history.last(slot) > 2.0 * guard.level)
      continue;
    const Bernstein p = history.polynomial(slot);
    if (p.at_least(guard.level)) {
      if (guard.low) note(slot);
      guard.low = false;
      guard.high = guard.level;
      continue;
    }
    for (int look = 0; look <= looks; ++look) {
      const double x = limit * look / looks, value = p.value(x);
      if (value >= guard.level) {
        if (guard.low) note(slot);
        guard.low = false;
      } else if (value < guard.high - guard.dip && (!guard.low || value < guard.lowest)) {
        guard.low = true;
        guard.lowest = value;
        guard.t_lowest = history.begin() + x * (history.end() - history.begin());
      }
      guard.high = std::min(guard.level, std::max(guard.high, value));
    }
  }
}

void Grazes::end(const std::vector<std::size_t>& fallen) {
  for (std::size_t slot = 0; slot < guards_.size(); ++slot)
    if (guards_[slot].low && guards_[slot].high < guards_[slot].level &&
        std::find(fallen.begin(), fallen.end(), slot) == fallen.end())
      note(slot);
  guards_.clear();
}

void Grazes::note(std::size_t slot) {
  if (!first_ || guards_[slot].t_lowest < first_->t)
    first_ = Graze{guards_[slot].t_lowest, slot, guards_[slot].guard};
}

}  // namespace signorini
