#include "engine/events/graze_detector.hpp"

#include <algorithm>

namespace signorini::events {
namespace {
// Number of sample intervals per step; the polynomial of a step has degree 5 at most.
constexpr int samples_per_step = 8;
}  // namespace

void GrazeDetector::start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels) {
  guards_.assign(guards.size(), GuardHistory{});
  for (std::size_t slot = 0; slot < guards.size(); ++slot) {
    guards_[slot].guard = guards[slot].kind;
    guards_[slot].level = levels[slot];
    guards_[slot].dip = dip_fraction * levels[slot] + guards[slot].noise;
  }
}

void GrazeDetector::update(const StepHistory& history, double limit) {
  for (std::size_t slot = 0; slot < guards_.size(); ++slot) {
    GuardHistory& guard = guards_[slot];
    if (guard.guard == Guard::none) continue;
    // clearly_positive(): on the step the guard varies by less than half of its last value, so it stays above the level.
    if (guard.high == guard.level && !guard.low && history.clearly_positive(slot) &&
        history.last(slot) > 2.0 * guard.level)
      continue;
    const Bernstein p = history.polynomial(slot);
    if (p.at_least(guard.level)) {
      if (guard.low) record(slot);
      guard.low = false;
      guard.high = guard.level;
      continue;
    }
    for (int look = 0; look <= samples_per_step; ++look) {
      const double x = limit * look / samples_per_step, value = p.value(x);
      if (value >= guard.level) {
        if (guard.low) record(slot);
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

void GrazeDetector::end(const std::vector<std::size_t>& fallen) {
  for (std::size_t slot = 0; slot < guards_.size(); ++slot)
    if (guards_[slot].low && guards_[slot].high < guards_[slot].level &&
        std::find(fallen.begin(), fallen.end(), slot) == fallen.end())
      record(slot);
  guards_.clear();
}

void GrazeDetector::record(std::size_t slot) {
  if (!first_ || guards_[slot].t_lowest < first_->t)
    first_ = Graze{guards_[slot].t_lowest, slot, guards_[slot].guard};
}

namespace {

constexpr double near_levels = 1e4;  // largest gap of a near hit, in levels: the error of 1e4 steps; chosen
constexpr std::size_t max_near_hits = 100000;

}  // namespace

void NearHitDetector::start(const std::vector<decide::GuardStart>& guards, const std::vector<double>& levels,
                            const ForceLayout& layout) {
  gaps_.clear();
  for (std::size_t slot = 0; slot < guards.size(); ++slot)
    if (guards[slot].kind == Guard::closing)
      gaps_.push_back({slot, static_cast<int>(layout.contact_of_guard(slot)), levels[slot], 0.0, 0, {}, {}});
}

void NearHitDetector::update(const StepHistory& history, double limit) {
  for (GapHistory& gap : gaps_) {
    // clearly_positive(): on the step the gap varies by less than half of its last value, so the gap is too large for a near
    // hit.
    if (history.clearly_positive(gap.slot) && history.last(gap.slot) > 2.0 * near_levels * gap.level) {
      gap.sample_count = 0;
      gap.high = history.last(gap.slot);
      continue;
    }
    const Bernstein p = history.polynomial(gap.slot);
    for (int i = gap.sample_count == 0 ? 0 : 1; i <= samples_per_step; ++i) {
      const double x = limit * i / samples_per_step;
      update_gap(gap, {history.begin() + x * (history.end() - history.begin()), p.value(x)});
    }
  }
}

void NearHitDetector::update_gap(GapHistory& gap, const GapSample& now) {
  const GapSample a = gap.before, b = gap.last;
  gap.before = b;
  gap.last = now;
  gap.high = std::max(gap.high, a.gap);
  if (++gap.sample_count < 3 || !(a.gap > b.gap && b.gap <= now.gap) || list_.size() == max_near_hits) return;
  const double left = b.t - a.t, right = now.t - b.t;
  const double up_left = (a.gap - b.gap) / left, up_right = (now.gap - b.gap) / right;
  const double bend = (up_left + up_right) / (left + right);
  const double off = (up_left * right - up_right * left) / (left + right) / (2.0 * bend);
  const double least = b.gap - bend * off * off;
  if (!(gap.high > gap.level)) return;
  gap.high = 0.0;
  if (least < near_levels * gap.level) list_.push_back({b.t + off, gap.contact, std::max(0.0, least), bend});
}

}  // namespace signorini::events
