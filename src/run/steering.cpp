#include "run/steering.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/history/pieces.hpp"
#include "base/text.hpp"
#include "model/internal_units.hpp"
#include "motion/point.hpp"
#include "run/choose_engine.hpp"
#include "signorini/error.hpp"

namespace signorini::run {
namespace {

bool is_given(const Load& load) {
  return load.kind == LoadKind::force || load.kind == LoadKind::moment || load.kind == LoadKind::distributed;
}

}  // namespace

void LoadChanges::set_load(const std::string& name, const History& history) {
  std::vector<std::string> names;
  for (const Load& load : model_.loads)
    if (is_given(load)) names.push_back(load.name);
  const auto found = std::find_if(model_.loads.begin(), model_.loads.end(),
                                  [&](const Load& load) { return is_given(load) && load.name == name; });
  if (found == model_.loads.end())
    throw SceneError(run_.place, "set_load",
                     fmt::format("found \"{}\", expected a force or a moment of the scene{}", name,
                                 base::suggestion(name, names)));
  const History next = model::rescaled(history, found->history_unit, scene::inverse(model_.unit));
  const double before = found->history.value(t_), after = next.value(t_);
  past_.push_back(std::exchange(found->history, found->history.then(t_, next)));
  for (std::vector<Output>* outputs : {&model_.outputs, &model_.reaction_sums})
    for (Output& output : *outputs)
      for_each_linear(output, [&](Output& linear) {
        for (Output::Given& given : linear.given)
          if (given.load == found->name) given.history = found->history.scaled(given.factor);
      });
  engine_.refuse(model_, run_);
  if (method_.flow == "modal" && !choose_flow(model_, run_).modal)
    throw SceneError(run_.place, "set_load",
                     "run.flow = \"modal\" needs loads that change in jumps only; use run.flow = \"taylor\"");
  requested_.any = true;
  requested_.jump = requested_.jump || before != after;
}

namespace {

/// A breakpoint, and the history to which it belongs.
struct Owned {
  Breakpoint at;
  const History* history;
};

/// True if the value of f before the breakpoint at `first` differs from its value after the breakpoint at `last` by more
/// than rounding.
bool leaps(const History& f, double first, double last) {
  const Piece &before = f.piece_before(first), &after = f.piece(last);
  return std::abs(after.value(last) - before.value(first)) >
         history::roundoff(before, first) + history::roundoff(after, last);
}

/// Merges the breakpoints [first, last) into one, at the last of their times.
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
      return o.at.time - first->at.time > motion::resolution_at(o.at.time, 0.0);
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

}  // namespace signorini::run
