#include "engine/events/active_guards.hpp"

#include <algorithm>
#include <utility>

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

namespace {
constexpr double resolution = 1e-12;  // relative to a step; the engine refines on its dense output
}

void Watch::start(const std::vector<GuardStart>& guards, GuardForms forms, std::vector<double> levels) {
  arming_.start(guards);
  forms_ = std::move(forms);
  levels_ = std::move(levels);
}

void Watch::wait(std::size_t slot, double level) {
  arming_.wait(slot);
  levels_[slot] = std::max(levels_[slot], level);
}

double Watch::leeway(std::size_t contact, const GuardForm& guard) const {
  const std::size_t end = std::min(guard_slot(contact + 1, 0), arming_.size());
  for (std::size_t slot = guard_slot(contact, 0); slot < end; ++slot)
    if (!arming_.idle(slot) && forms_[contact][guard_within(slot)] == guard)
      return arming_.armed(slot) ? 0.0 : levels_[slot];
  return 0.0;
}

std::vector<Fall> Watch::check(const StepHistory& history, double limit) {
  std::vector<Fall> falls;
  for (std::size_t slot = 0; slot < arming_.size(); ++slot) {
    if (arming_.idle(slot) || (arming_.armed(slot) && history.clearly_positive(slot))) continue;
    Bernstein p = history.polynomial(slot);
    if (arming_.armed(slot) && p.positive()) continue;
    double from = 0.0;
    if (!arming_.armed(slot)) {
      const double level = levels_[slot];
      const auto rise = first_reach(p, level, resolution);
      Bernstein negative = p;
      for (double& b : negative.b) b = -b;
      const auto sink = first_reach(negative, level, resolution);
      if (sink && (!rise || *sink < *rise)) {
        if (*sink <= limit) falls.push_back({slot, *sink});
        continue;
      }
      if (!rise) continue;
      arming_.arm(slot);
      from = *rise;
      Bernstein before, after;
      p.split(from, before, after);
      p = after;
    }
    if (const auto x = first_fall(p, resolution)) {
      const double at = from + (1.0 - from) * *x;
      if (at <= limit) falls.push_back({slot, at});
    }
  }
  return falls;
}

}  // namespace signorini
