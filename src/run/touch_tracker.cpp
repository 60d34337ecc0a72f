#include "run/touch_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::run {

void Landings::begin(double t, const contact::ContactStates& mode) {
  lasts_.assign(mode.size(), false);
  for (std::size_t k = 0; k < mode.size(); ++k)
    if (!model_.contacts[k].normal_force_given() && !mode[k].is_open()) {
      now_[k] = {t, t, 0.0, 0.0};
      lasts_[k] = true;
    }
}

void Landings::add(const motion::WorkIntegrals& works) {
  for (std::size_t k = 0; k < lasts_.size(); ++k)
    if (lasts_[k]) now_[k].impulse += works.applied_normal_force[k];
}

void Landings::observe(std::size_t k, double N) {
  if (lasts_[k]) now_[k].peak_force = std::max(now_[k].peak_force, -N);
}

void Landings::instant(double t, const decide::Decision& decision, const contact::ContactStates& old_mode) {
  for (std::size_t k = 0; k < lasts_.size(); ++k) {
    if (model_.contacts[k].normal_force_given()) continue;
    const bool was = !old_mode[k].is_open(), is = !decision.mode[k].is_open();
    const double pushed = decision.impulses.empty() ? 0.0 : decision.impulses[k].normal;
    if (was) observe(k, decision.before[k].N);
    if (!was && !is && !(pushed > 0.0)) continue;
    if (!was) now_[k] = {t, t, 0.0, 0.0};
    if (pushed > 0.0) now_[k].impulse += pushed;
    now_[k].end = t;
    lasts_[k] = is;
    if (is)
      observe(k, decision.after[k].N);
    else
      ended_[k].push_back(now_[k]);
  }
}

std::vector<std::vector<Landing>> Landings::finish(double t, const contact::ContactStates& mode) const {
  std::vector<std::vector<Landing>> result = ended_;
  for (std::size_t k = 0; k < lasts_.size(); ++k) {
    if (!lasts_[k]) continue;
    result[k].push_back(now_[k]);
    if (k < mode.size()) result[k].back().end = t;
  }
  return result;
}

}  // namespace signorini::run
