#include "sensitivity/landing_rates.hpp"

namespace signorini {
namespace {

template <class Value>
std::vector<double> of_each(const std::vector<TangentState>& states, const Value& value) {
  std::vector<double> rates;
  for (const TangentState& state : states) rates.push_back(state.alive ? value(state) : EventRates::none);
  return rates;
}

}  // namespace

void LandingRecord::begin(std::size_t c, const std::vector<double>& start,
                          const std::vector<TangentState>& states) {
  Stay& stay = all_[c].emplace_back();
  stay.landing.contact = static_cast<int>(c);
  stay.from = of_each(states, [&](const TangentState& s) { return s.along.works.pressing[c]; });
  for (const double t : start) stay.landing.rates.push_back({t, t, 0.0, 0.0});
}

void LandingRecord::offer(std::size_t c, double force, const std::vector<double>& rates) {
  MovingLanding& landing = all_[c].back().landing;
  if (!(force > landing.value.peak_force)) return;
  landing.value.peak_force = force;
  for (std::size_t p = 0; p < parameters_; ++p) landing.rates[p].peak_force = rates[p];
}

void LandingRecord::turn(const TangentSample& s) {
  for (std::size_t c = 0; c < all_.size(); ++c) {
    if (!lasts_[c]) continue;
    const auto n = static_cast<Eigen::Index>(model_.layout.normal(c));
    std::vector<double> rates;
    for (const SeriesPoint& w : s.tangents) rates.push_back(w.u.size() > 0 ? -w.forces[n] : EventRates::none);
    offer(c, -s.point.forces[n], rates);
  }
}

void LandingRecord::instant(const InstantMotion& m, const std::vector<TangentState>& states) {
  const Decision& decision = m.instant.after;
  for (std::size_t c = 0; c < all_.size(); ++c) {
    if (model_.contacts[c].normal_force_given()) continue;
    const bool was = !m.instant.mode_before[c].is_open(), is = !decision.mode[c].is_open();
    if (!begun_ && was) begin(c, std::vector<double>(parameters_, 0.0), states);
    const double pushed = decision.impulses.empty() ? 0.0 : decision.impulses[c].normal;
    const std::vector<double> t = of_each(states, [&](const TangentState& s) { return s.rates[c].t; });
    if (was) offer(c, -m.motion_before[c].N, of_each(states, [&](const auto& s) { return -s.rates[c].N; }));
    if (!was && (is || pushed > 0.0)) begin(c, t, states);
    lasts_[c] = is;
    if (!was && !is && !(pushed > 0.0)) continue;
    Stay& stay = all_[c].back();
    const auto work = of_each(states, [&](const TangentState& s) { return s.along.works.pressing[c]; });
    for (std::size_t p = 0; p < parameters_; ++p) {
      LandingRates& rates = stay.landing.rates[p];
      rates.end = t[p];
      rates.impulse += work[p] - stay.from[p];
      if (pushed > 0.0) rates.impulse += states[p].alive ? states[p].impulses[c] : EventRates::none;
    }
    stay.from = work;
    if (is)
      offer(c, -m.motion_after[c].N, of_each(states, [&](const auto& s) { return -s.rates[c].N_after; }));
  }
  begun_ = true;
}

std::vector<std::vector<MovingLanding>> LandingRecord::finish(const std::vector<TangentState>& states) const {
  std::vector<std::vector<MovingLanding>> result(all_.size());
  for (std::size_t c = 0; c < all_.size(); ++c) {
    for (const Stay& stay : all_[c]) result[c].push_back(stay.landing);
    if (!lasts_[c]) continue;
    const Stay& last = all_[c].back();
    const auto work =
        of_each(states, [&](const TangentState& s) { return s.works->now().works.pressing[c]; });
    for (std::size_t p = 0; p < parameters_; ++p) {
      LandingRates& rates = result[c].back().rates[p];
      rates.end = states[p].alive ? 0.0 : EventRates::none;
      rates.impulse += work[p] - last.from[p];
    }
  }
  return result;
}

}  // namespace signorini
