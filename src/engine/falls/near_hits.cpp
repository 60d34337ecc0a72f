#include "engine/falls/near_hits.hpp"

#include <algorithm>

namespace signorini {
namespace {

constexpr double near_levels = 1e4;  // chosen: error of a run of that many steps
constexpr int looks_a_step = 8;      // a step's polynomial has at most five turning points
constexpr std::size_t most_near_hits = 100000;

}  // namespace

void NearHits::start(const std::vector<GuardStart>& guards, const std::vector<double>& levels) {
  gaps_.clear();
  for (std::size_t slot = 0; slot < guards.size(); ++slot)
    if (guards[slot].kind == Guard::closing) gaps_.push_back({slot, levels[slot], 0.0, 0, {}, {}});
}

void NearHits::see(const StepHistory& history, double limit) {
  for (Watched& gap : gaps_) {
    // If the last value is twice the bend that the older values can cause, the gap stays above half of it on the step.
    if (history.clearly_positive(gap.slot) && history.last(gap.slot) > 2.0 * near_levels * gap.level) {
      gap.looks = 0;
      gap.high = history.last(gap.slot);
      continue;
    }
    const Bernstein p = history.polynomial(gap.slot);
    for (int i = gap.looks == 0 ? 0 : 1; i <= looks_a_step; ++i) {
      const double x = limit * i / looks_a_step;
      look(gap, {history.begin() + x * (history.end() - history.begin()), p.value(x)});
    }
  }
}

void NearHits::look(Watched& gap, const Look& now) {
  const Look a = gap.before, b = gap.last;
  gap.before = b;
  gap.last = now;
  gap.high = std::max(gap.high, a.gap);
  if (++gap.looks < 3 || !(a.gap > b.gap && b.gap <= now.gap) || list_.size() == most_near_hits) return;
  const double left = b.t - a.t, right = now.t - b.t;
  const double up_left = (a.gap - b.gap) / left, up_right = (now.gap - b.gap) / right;
  const double bend = (up_left + up_right) / (left + right);
  const double off = (up_left * right - up_right * left) / (left + right) / (2.0 * bend);
  const double least = b.gap - bend * off * off;
  if (!(gap.high > gap.level)) return;
  gap.high = 0.0;
  if (least < near_levels * gap.level)
    list_.push_back({b.t + off, static_cast<int>(contact_of_guard(gap.slot)), std::max(0.0, least), bend});
}

}  // namespace signorini
