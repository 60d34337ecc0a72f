#include "run/landings.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

void Landings::begin(double t, const Mode& mode) {
  lasts_.assign(mode.size(), false);
  for (std::size_t k = 0; k < mode.size(); ++k)
    if (model_.contacts[k].has_gap() && !mode[k].is_open()) {
      all_[k].push_back({t, t, 0.0, 0.0});
      lasts_[k] = true;
    }
}

void Landings::add(const Works& works) {
  for (std::size_t k = 0; k < lasts_.size(); ++k)
    if (lasts_[k]) all_[k].back().impulse += works.pressing[k];
}

void Landings::observe(std::size_t k, double N) {
  if (lasts_[k]) all_[k].back().peak_force = std::max(all_[k].back().peak_force, -N);
}

void Landings::instant(double t, const Decision& decision, const Mode& old_mode) {
  for (std::size_t k = 0; k < lasts_.size(); ++k) {
    if (model_.contacts[k].is_pressed()) continue;
    const bool was = !old_mode[k].is_open(), is = !decision.mode[k].is_open();
    const double pushed = decision.impulses.empty() ? 0.0 : decision.impulses[k].normal;
    if (was) observe(k, decision.before[k].N);
    if (!was && (is || pushed > 0.0)) all_[k].push_back({t, t, 0.0, 0.0});
    if (pushed > 0.0) all_[k].back().impulse += pushed;
    lasts_[k] = is;
    if (was || is || pushed > 0.0) all_[k].back().end = t;
    if (is) observe(k, decision.after[k].N);
  }
}

std::vector<std::vector<Landing>> Landings::finish(double t, const Mode& mode) const {
  std::vector<std::vector<Landing>> result = all_;
  for (std::size_t k = 0; k < lasts_.size() && k < mode.size(); ++k)
    if (lasts_[k]) result[k].back().end = t;
  return result;
}

}  // namespace signorini
