#include "run/touch_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::run {

void LandingTracker::begin(double t, const contact::ContactStates& states) {
  active_.assign(states.size(), false);
  for (std::size_t k = 0; k < states.size(); ++k)
    if (!model_.contacts[k].normal_force_given() && !states[k].is_open()) {
      now_[k] = {t, t, 0.0, 0.0};
      active_[k] = true;
    }
}

void LandingTracker::add(const motion::WorkIntegrals& works) {
  for (std::size_t k = 0; k < active_.size(); ++k)
    if (active_[k]) now_[k].impulse += works.applied_normal_force[k];
}

void LandingTracker::observe(std::size_t k, double N) {
  if (active_[k]) now_[k].peak_force = std::max(now_[k].peak_force, -N);
}

void LandingTracker::instant(double t, const decide::Decision& decision,
                             const contact::ContactStates& old_states) {
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (model_.contacts[k].normal_force_given()) continue;
    const bool was = !old_states[k].is_open(), is = !decision.states[k].is_open();
    const double pushed = decision.impulses.empty() ? 0.0 : decision.impulses[k].normal;
    if (was) observe(k, decision.before[k].N);
    if (!was && !is && !(pushed > 0.0)) continue;
    if (!was) now_[k] = {t, t, 0.0, 0.0};
    if (pushed > 0.0) now_[k].impulse += pushed;
    now_[k].end = t;
    active_[k] = is;
    if (is)
      observe(k, decision.after[k].N);
    else
      ended_[k].push_back(now_[k]);
  }
}

std::vector<std::vector<Landing>> LandingTracker::finish(double t,
                                                         const contact::ContactStates& states) const {
  std::vector<std::vector<Landing>> result = ended_;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (!active_[k]) continue;
    result[k].push_back(now_[k]);
    if (k < states.size()) result[k].back().end = t;
  }
  return result;
}

}  // namespace signorini::run
