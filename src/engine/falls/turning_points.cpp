#include "engine/falls/turning_points.hpp"

#include <algorithm>

namespace signorini {
namespace {

constexpr std::size_t turn_samples = 8;  // a step turns by less than 4 rad of any mode that matters

}  // namespace

void TurningPoints::start(const Decision& decision) {
  for (std::size_t c = 0; c < decision.after.size(); ++c) {
    const ContactMotion& m = decision.after[c];
    const std::array<double, 4> now{m.N, m.T, m.gap, decision.slides_after[c].ut};
    for (std::size_t i = 0; i < now.size(); ++i) {
      Range& range = ranges_[watched.size() * c + i];
      // Each landing has a peak of its own.
      const bool lands = watched[i] == ContactSeries::N && began_ && decision.before[c].N == 0.0;
      if (lands) range = {now[i], now[i]};
      range.least = began_ ? std::min(range.least, now[i]) : now[i];
      range.greatest = began_ ? std::max(range.greatest, now[i]) : now[i];
    }
  }
  began_ = true;
}

void TurningPoints::find(const std::vector<ContactSeries>& contacts, const Series& series, double x_end) {
  times_.clear();
  std::array<double, turn_samples + 1> x{}, value{};
  for (std::size_t i = 0; i <= turn_samples; ++i)
    x[i] = x_end * static_cast<double>(i) / static_cast<double>(turn_samples);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t f = 0; f < watched.size(); ++f) {
      const double* a = contacts[c].of(watched[f]);
      const std::size_t degree = contacts[c].degree();
      Range& range = ranges_[watched.size() * c + f];
      value.fill(a[degree]);
      for (std::size_t k = degree; k-- > 0;)
        for (std::size_t i = 0; i <= turn_samples; ++i) value[i] = value[i] * x[i] + a[k];
      const auto see = [&](double v) {
        range.least = std::min(range.least, v);
        range.greatest = std::max(range.greatest, v);
      };
      see(value.front());
      see(value.back());
      for (std::size_t i = 1; i < turn_samples; ++i) {
        const double left = value[i] - value[i - 1], right = value[i + 1] - value[i];
        if (left * right > 0.0 || left == right) continue;
        // The parabola through three values turns here; a tenth more for what it leaves out.
        const double rise = -(right + left) * (right + left) / (8.0 * (right - left));
        const double turn = value[i] + 1.1 * rise;
        if (turn >= range.least && turn <= range.greatest) continue;
        double at = x[i] - 0.5 * (x[i + 1] - x[i]) * (right + left) / (right - left);
        for (int newton = 0; newton < 4; ++newton) {
          double slope = 0.0, bend = 0.0;
          for (std::size_t k = degree; k >= 1; --k) {
            bend = bend * at + slope;
            slope = slope * at + static_cast<double>(k) * a[k];
          }
          if (bend != 0.0) at = std::clamp(at - slope / bend, x[i - 1], x[i + 1]);
        }
        see(contacts[c].value(watched[f], at));
        times_.push_back(series.t + at * series.scale);
      }
    }
  std::sort(times_.begin(), times_.end());
}

}  // namespace signorini
