#include "engine/events/active_guards.hpp"

#include <algorithm>
#include <utility>

namespace signorini::events {

void ActiveGuards::start(const std::vector<decide::GuardStart>& guards) {
  guards_.resize(guards.size());
  for (std::size_t slot = 0; slot < guards.size(); ++slot) {
    const decide::GuardStart& guard = guards[slot];
    if (guard.kind == Guard::none)
      guards_[slot] = {Status::idle, 0};
    else if (guard.at_zero)
      guards_[slot] = {Status::waiting, static_cast<std::size_t>(std::max(guard.leading_order, 0))};
    else
      guards_[slot] = {Status::armed, 0};
  }
}

void ActiveGuards::update(std::size_t slot, double value, double level) {
  if (guards_[slot].status != Status::waiting) return;
  guards_[slot] = {value > level ? Status::armed : Status::waiting, 0};
}

namespace {
// Resolution of the place of a root, relative to the step length. Coarse, because the engine refines the root.
constexpr double relative_resolution = 1e-12;
}  // namespace

void GuardMonitor::start(const std::vector<decide::GuardStart>& guards, decide::GuardForms forms,
                         std::vector<double> levels, const ForceLayout& layout) {
  active_guards_.start(guards);
  forms_ = std::move(forms);
  layout_ = layout;
  levels_ = std::move(levels);
}

void GuardMonitor::set_waiting(std::size_t slot, double level) {
  active_guards_.set_waiting(slot);
  levels_[slot] = std::max(levels_[slot], level);
}

double GuardMonitor::allowed_depth(std::size_t contact, const GuardForm& guard) const {
  if (layout_.contacts() == 0) return 0.0;  // no segment has started yet
  const std::size_t first = layout_.guard(contact), end = layout_.guard_end(contact);
  for (std::size_t slot = first; slot < end; ++slot)
    if (!active_guards_.idle(slot) && forms_[contact][slot - first] == guard)
      return active_guards_.armed(slot) ? 0.0 : levels_[slot];
  return 0.0;
}

std::vector<ZeroCrossing> GuardMonitor::check(const StepHistory& history, double limit) {
  std::vector<ZeroCrossing> falls;
  for (std::size_t slot = 0; slot < active_guards_.size(); ++slot) {
    if (active_guards_.idle(slot) || (active_guards_.armed(slot) && history.clearly_positive(slot))) continue;
    Bernstein p = history.polynomial(slot);
    if (active_guards_.armed(slot) && p.positive()) continue;
    double from = 0.0;
    if (!active_guards_.armed(slot)) {
      const double level = levels_[slot];
      const auto rise = first_upcrossing(p, level, relative_resolution);
      Bernstein negative = p;
      for (double& b : negative.b) b = -b;
      const auto sink = first_upcrossing(negative, level, relative_resolution);
      if (sink && (!rise || *sink < *rise)) {
        if (*sink <= limit) falls.push_back({slot, *sink});
        continue;
      }
      if (!rise) continue;
      active_guards_.set_armed(slot);
      from = *rise;
      Bernstein before, after;
      p.split(from, before, after);
      p = after;
    }
    if (const auto x = first_root(p, relative_resolution)) {
      const double at = from + (1.0 - from) * *x;
      if (at <= limit) falls.push_back({slot, at});
    }
  }
  return falls;
}

}  // namespace signorini::events
