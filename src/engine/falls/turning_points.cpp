#include "engine/falls/turning_points.hpp"

#include <algorithm>

namespace signorini {
namespace {

/// Where the slope of a polynomial is zero, by Newton steps from a place; stays between low and high.
double turn_from(const double* a, std::size_t degree, double at, double low, double high) {
  for (int newton = 0; newton < 4; ++newton) {
    double slope = 0.0, bend = 0.0;
    for (std::size_t k = degree; k >= 1; --k) {
      bend = bend * at + slope;
      slope = slope * at + static_cast<double>(k) * a[k];
    }
    if (bend != 0.0) at = std::clamp(at - slope / bend, low, high);
  }
  return at;
}

double slope_at(const double* a, std::size_t degree, double x) {
  double slope = 0.0;
  for (std::size_t k = degree; k >= 1; --k) slope = slope * x + static_cast<double>(k) * a[k];
  return slope;
}

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

void TurningPoints::Range::see(double value) {
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void TurningPoints::find(const std::vector<ContactSeries>& contacts, const Series& series, double x_end,
                         Ends ends) {
  turns_.clear();
  Samples x{};
  for (std::size_t i = 0; i <= turn_samples; ++i)
    x[i] = x_end * static_cast<double>(i) / static_cast<double>(turn_samples);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t f = 0; f < watched.size(); ++f)
      find_of(contacts[c], watched.size() * c + f, x, series, ends);
  times_.clear();
  for (const Turn& turn : turns_) times_.push_back(turn.time);
  std::sort(times_.begin(), times_.end());
}

void TurningPoints::find_of(const ContactSeries& contact, std::size_t place, const Samples& x,
                            const Series& series, Ends ends) {
  const ContactSeries::Field field = watched[place % watched.size()];
  const double* a = contact.of(field);
  const std::size_t degree = contact.degree();
  Range& range = ranges_[place];
  Samples value{};
  value.fill(a[degree]);
  for (std::size_t k = degree; k-- > 0;)
    for (std::size_t i = 0; i <= turn_samples; ++i) value[i] = value[i] * x[i] + a[k];
  const auto record = [&](double at) {
    const double turn = contact.value(field, at);
    turns_.push_back({2 * place + (turn > range.greatest ? 1 : 0), series.t + at * series.scale});
    range.see(turn);
  };
  if (ends == Ends::searched)  // a turn beside an end shows no change of direction among the samples
    for (const std::size_t i : {std::size_t(0), turn_samples}) {
      const std::size_t next = i == 0 ? 1 : turn_samples - 1;
      if (slope_at(a, degree, x[i]) * (value[next] - value[i]) * (x[next] - x[i]) >= 0.0) continue;
      const double at = turn_from(a, degree, x[i], std::min(x[i], x[next]), std::max(x[i], x[next]));
      const double turn = contact.value(field, at);
      if (turn < range.least || turn > range.greatest) record(at);
    }
  range.see(value.front());
  range.see(value.back());
  for (std::size_t i = 1; i < turn_samples; ++i) {
    const double left = value[i] - value[i - 1], right = value[i + 1] - value[i];
    if (left * right > 0.0 || left == right) continue;
    // The parabola through three values turns here; a tenth more for what it leaves out.
    const double rise = -(right + left) * (right + left) / (8.0 * (right - left));
    const double turn = value[i] + 1.1 * rise;
    if (turn >= range.least && turn <= range.greatest) continue;
    const double guess = x[i] - 0.5 * (x[i + 1] - x[i]) * (right + left) / (right - left);
    record(turn_from(a, degree, guess, x[i - 1], x[i + 1]));
  }
}

}  // namespace signorini
