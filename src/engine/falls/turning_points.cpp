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

void TurningPoints::find(const std::vector<ContactSeries>& contacts, const Series& series, double x_end,
                         Ends ends) {
  turns_.clear();
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
      const auto turn_from = [&](double at, double low, double high) {
        for (int newton = 0; newton < 4; ++newton) {
          double slope = 0.0, bend = 0.0;
          for (std::size_t k = degree; k >= 1; --k) {
            bend = bend * at + slope;
            slope = slope * at + static_cast<double>(k) * a[k];
          }
          if (bend != 0.0) at = std::clamp(at - slope / bend, low, high);
        }
        return at;
      };
      const auto record = [&](double at) {
        const double turn = contacts[c].value(watched[f], at);
        turns_.push_back(
            {2 * (watched.size() * c + f) + (turn > range.greatest ? 1 : 0), series.t + at * series.scale});
        see(turn);
      };
      if (ends == Ends::searched)  // a turn beside an end shows no change of direction among the samples
        for (const std::size_t i : {std::size_t(0), turn_samples}) {
          const std::size_t next = i == 0 ? 1 : turn_samples - 1;
          double slope = 0.0;
          for (std::size_t k = degree; k >= 1; --k) slope = slope * x[i] + static_cast<double>(k) * a[k];
          if (slope * (value[next] - value[i]) * (x[next] - x[i]) >= 0.0) continue;
          const double at = turn_from(x[i], std::min(x[i], x[next]), std::max(x[i], x[next]));
          const double turn = contacts[c].value(watched[f], at);
          if (turn < range.least || turn > range.greatest) record(at);
        }
      see(value.front());
      see(value.back());
      for (std::size_t i = 1; i < turn_samples; ++i) {
        const double left = value[i] - value[i - 1], right = value[i + 1] - value[i];
        if (left * right > 0.0 || left == right) continue;
        // The parabola through three values turns here; a tenth more for what it leaves out.
        const double rise = -(right + left) * (right + left) / (8.0 * (right - left));
        const double turn = value[i] + 1.1 * rise;
        if (turn >= range.least && turn <= range.greatest) continue;
        record(
            turn_from(x[i] - 0.5 * (x[i + 1] - x[i]) * (right + left) / (right - left), x[i - 1], x[i + 1]));
      }
    }
  times_.clear();
  for (const Turn& turn : turns_) times_.push_back(turn.time);
  std::sort(times_.begin(), times_.end());
}

}  // namespace signorini
