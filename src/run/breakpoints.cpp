#include "run/breakpoints.hpp"

#include <algorithm>
#include <cmath>

#include "base/history/history_internal.hpp"
#include "motion/clock.hpp"

namespace signorini {

namespace {

/// A breakpoint and its history.
struct Owned {
  Breakpoint at;
  const History* history;
};

/// True if the changes of f between the two times, which count as one, change its value.
bool leaps(const History& f, double first, double last) {
  const Piece &before = f.piece_before(first), &after = f.piece(last);
  return std::abs(after.value(last) - before.value(first)) > roundoff(before, first) + roundoff(after, last);
}

/// Merges the breakpoints [first, last) into one instant.
Breakpoint merged(std::vector<Owned>::const_iterator first, std::vector<Owned>::const_iterator last) {
  Breakpoint one{std::prev(last)->at.time, false};
  for (auto i = first; i != last; ++i) {
    const bool again = std::any_of(first, i, [&](const Owned& o) { return o.history == i->history; });
    one.jump = one.jump || i->at.jump || (again && leaps(*i->history, first->at.time, one.time));
  }
  return one;
}

}  // namespace

std::vector<Breakpoint> breakpoints(const Model& model, double t_end) {
  std::vector<Owned> all;
  const auto add = [&](const History& history, bool values) {
    for (Breakpoint b : history.breakpoints()) {
      b.jump = b.jump && values;
      if (b.time > 0.0 && b.time < t_end) all.push_back({b, &history});
    }
  };
  for (const Load& load : model.loads) add(load.history, true);
  for (const Contact& contact : model.contacts) {
    add(contact.normal_force, true);
    add(contact.surface_motion, false);
  }
  std::sort(all.begin(), all.end(), [](const Owned& a, const Owned& b) { return a.at.time < b.at.time; });
  std::vector<Breakpoint> result;
  for (auto first = all.cbegin(); first != all.cend();) {
    const auto last = std::find_if(first, all.cend(), [&](const Owned& o) {
      return o.at.time - first->at.time > resolution_at(o.at.time, 0.0);
    });
    result.push_back(merged(first, last));
    first = last;
  }
  return result;
}

BreakpointQueue::Passed BreakpointQueue::pass(double& t, double resolution) {
  Passed passed;
  for (; next_ < list_.size() && list_[next_].time - t <= resolution; ++next_) {
    passed.any = true;
    passed.jump = passed.jump || list_[next_].jump;
    t = list_[next_].time;
  }
  return passed;
}

void BreakpointQueue::loads_changed(const Model& model, double t) {
  list_ = breakpoints(model, t_end_);
  const auto after = std::upper_bound(list_.begin(), list_.end(), t,
                                      [](double time, const Breakpoint& b) { return time < b.time; });
  next_ = static_cast<std::size_t>(after - list_.begin());
}

}  // namespace signorini
