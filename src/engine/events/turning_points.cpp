#include "engine/events/turning_points.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/events/first_root.hpp"

namespace signorini::events {
namespace {

/// The first and second derivative of a polynomial.
class Slope {
 public:
  Slope(const double* a, std::size_t degree) : degree_(degree) {
    for (std::size_t k = 1; k <= degree; ++k) b_[k] = static_cast<double>(k) * a[k];
  }
  [[nodiscard]] double at(double x) const {
    double slope = 0.0;
    for (std::size_t k = degree_; k >= 1; --k) slope = slope * x + b_[k];
    return slope;
  }
  /// Zero of the first derivative, by four Newton steps from the place `at`. The result is between low and high.
  [[nodiscard]] double zero_from(double at, double low, double high) const {
    for (int newton = 0; newton < 4; ++newton) {
      double slope = 0.0, bend = 0.0;
      for (std::size_t k = degree_; k >= 1; --k) {
        bend = bend * at + slope;
        slope = slope * at + b_[k];
      }
      if (bend != 0.0) at = std::clamp(at - slope / bend, low, high);
    }
    return at;
  }

 private:
  std::size_t degree_;
  std::array<double, max_root_degree + 1> b_;  // b_[k] = k a_k, k = 1 .. degree
};

/// Place of an extreme between `end` and `next`, by bisection and then Newton steps. Newton steps from `end` alone would not
/// leave `end` if the slope is zero there, as after an impact that stops a slip.
double extreme_near_end(const double* a, std::size_t degree, double end, double next, double inward) {
  const Slope slope(a, degree);
  const double forth = next > end ? inward : -inward;  // sign of the slope at `next`
  double near = end, far = next;
  for (int halved = 0; halved < 12; ++halved) {
    const double middle = 0.5 * (near + far);
    (slope.at(middle) * forth < 0.0 ? near : far) = middle;
  }
  return slope.zero_from(0.5 * (near + far), std::min(near, far), std::max(near, far));
}

}  // namespace

void TurningPointDetector::start(const decide::Decision& decision) {
  values_.resize(ranges_.size());
  for (std::size_t c = 0; c < decision.after.size(); ++c) {
    const ContactMotion& m = decision.after[c];
    const std::array<double, 4> now{m.N, m.T, m.gap, decision.slides_after[c].ut};
    for (std::size_t i = 0; i < now.size(); ++i) {
      Range& range = ranges_[watched_fields.size() * c + i];
      values_[watched_fields.size() * c + i] = now[i];
      // The peak force of each landing is reported separately, so the range of N starts anew.
      const bool lands =
          watched_fields[i] == motion::ContactSeries::N && began_ && decision.before[c].N == 0.0;
      if (lands) range = {now[i], now[i]};
      range.least = began_ ? std::min(range.least, now[i]) : now[i];
      range.greatest = began_ ? std::max(range.greatest, now[i]) : now[i];
    }
  }
  began_ = true;
}

void TurningPointDetector::Range::extend(double value) {
  least = std::min(least, value);
  greatest = std::max(greatest, value);
}

void TurningPointDetector::open() {
  turning_points_.clear();
  times_.clear();
}

void TurningPointDetector::close() {
  if (turning_points_.empty()) return;
  for (const TurningPoint& turn : turning_points_) times_.push_back(turn.time);
  std::sort(times_.begin(), times_.end());
}

void TurningPointDetector::find(const std::vector<motion::ContactSeries>& contacts,
                                const motion::Series& series, double x_begin, double x_end, Ends ends) {
  open();
  double origin = 0.0;
  Samples x = samples_of(x_begin, x_end);
  const auto stays_by_rate = [&](std::size_t place, double rate) {
    if (values_.empty()) return false;
    const double value = values_[place],
                 change = (1.0 + rounding::many_operations) * rate * (x_end - x_begin);
    return ranges_[place].contains(value, change, rounding::many_operations * (std::abs(value) + change));
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].origin() != origin) {
      origin = contacts[c].origin();
      x = samples_of(x_begin - origin, x_end - origin);
    }
    const double begin = series.t + origin * series.scale;
    for (std::size_t f = 0; f < watched_fields.size(); ++f) {
      const std::size_t place = watched_fields.size() * c + f;
      if (stays_by_rate(place, contacts[c].rate(watched_fields[f]))) continue;
      find_on_path({contacts[c].coefficients(watched_fields[f]), contacts[c].degree(), begin, series.scale},
                   place, x, ends);
    }
  }
  values_.clear();
  close();
}

void TurningPointDetector::find(std::size_t contact, motion::ContactSeries::Field field, const double* a,
                                std::size_t degree, double x_end, double begin, double scale) {
  find_on_path({a, degree, begin, scale}, range_index(contact, field), samples_of(0.0, x_end),
               Ends::observed);
}

std::optional<TurningPointDetector::TurningPoint> TurningPointDetector::find_at_start(
    std::size_t contact, motion::ContactSeries::Field field, double value, double rate, double time) {
  const std::size_t place = range_index(contact, field);
  Range& range = ranges_[place];
  const bool above = value > range.greatest, below = value < range.least;
  if (!(above && rate <= 0.0) && !(below && rate >= 0.0)) return std::nullopt;
  range.extend(value);
  return TurningPoint{2 * place + (above ? 1 : 0), time};
}

TurningPointDetector::Samples TurningPointDetector::samples_of(double x_begin, double x_end) {
  Samples x{};
  for (std::size_t i = 0; i <= sample_intervals; ++i)
    x[i] = x_begin + (x_end - x_begin) * static_cast<double>(i) / static_cast<double>(sample_intervals);
  return x;
}

void TurningPointDetector::record(const Path& path, std::size_t place, double at) {
  Range& range = ranges_[place];
  const double turn = motion::value_at(path.a, path.degree, at);
  if (turn >= range.least && turn <= range.greatest) return;
  turning_points_.push_back({2 * place + (turn > range.greatest ? 1 : 0), path.begin + at * path.scale});
  range.extend(turn);
}

/// Finds a turning point between an end and the adjacent sample, if the samples are monotone: the slope at
/// the end then has the opposite sign, or is zero. For samples 0.5 rad apart, one-sided differences give the
/// slope with an error of 0.04 amplitudes, while the samples differ by 0.12 amplitudes near an extreme. So a
/// slope above half of their difference excludes an extreme.
void TurningPointDetector::find_near_end(std::size_t end, const Path& path, std::size_t place,
                                         const Samples& x, const Samples& value, Ends ends) {
  const bool first = end == 0;
  const std::size_t next = first ? 1 : sample_intervals - 1, third = first ? 2 : sample_intervals - 2;
  const Range& range = ranges_[place];
  const double inward = value[next] - value[end], slope = 2.0 * inward - 0.5 * (value[third] - value[end]);
  if (inward == 0.0 && slope == 0.0) return;
  if (inward * slope > 0.0 && std::abs(slope) >= 0.5 * std::abs(inward)) {
    // No observer evaluates the beginning of a part, so a new extreme value there is recorded as a turning point.
    const bool hidden = first && ends == Ends::part;
    if (hidden && (inward < 0.0 ? value[end] > range.greatest : value[end] < range.least))
      record(path, place, x[end]);
    return;
  }
  // A parabola with an extreme before `next` exceeds the value at the end by at most 1/8 of the difference between `third` and
  // the end. The limit is four times as large, plus `inward`, because the curve is not exactly a parabola.
  const double beyond = std::abs(inward) + 0.5 * std::abs(value[third] - value[end]);
  if (inward > 0.0 ? value[end] - beyond >= range.least : value[end] + beyond <= range.greatest) return;
  record(path, place, extreme_near_end(path.a, path.degree, x[end], x[next], inward));
}

/// True if a bound proves that f stays within its earlier range. First bound: |f - f(0)| <= sum of |a_k| x_end^k. Second bound:
/// |f - f(middle)| <= half of the interval times the sum of k |a_k| x_end^(k-1).
bool TurningPointDetector::stays_in_range(const Path& path, const Range& range, const Samples& x) {
  const double x_end = x[sample_intervals];
  double reach = 0.0, power = 1.0;
  for (std::size_t k = 1; k <= path.degree; ++k) {
    power *= x_end;
    reach += std::abs(path.a[k]) * power;
  }
  const double a = path.a[0], rounding = rounding::many_operations * (std::abs(a) + reach);
  if (range.contains(a, reach, rounding)) return true;
  if (x[0] == 0.0) return false;
  double slope = 0.0;
  power = 1.0;
  for (std::size_t k = 1; k <= path.degree; ++k) {
    slope += static_cast<double>(k) * std::abs(path.a[k]) * power;
    power *= x_end;
  }
  const double middle = motion::value_at(path.a, path.degree, 0.5 * (x[0] + x_end));
  return range.contains(middle, 0.5 * (x_end - x[0]) * slope, rounding);
}

void TurningPointDetector::find_on_path(const Path& path, std::size_t place, const Samples& x, Ends ends) {
  Range& range = ranges_[place];
  if (stays_in_range(path, range, x)) return;
  Samples value{};
  value.fill(path.a[path.degree]);
  for (std::size_t k = path.degree; k-- > 0;)
    for (std::size_t i = 0; i <= sample_intervals; ++i) value[i] = value[i] * x[i] + path.a[k];
  if (ends != Ends::part) range.extend(value.front());
  if (ends == Ends::observed) range.extend(value.back());
  find_near_end(0, path, place, x, value, ends);
  for (std::size_t i = 1; i < sample_intervals; ++i) {
    const double left = value[i] - value[i - 1], right = value[i + 1] - value[i];
    if (left * right > 0.0 || left == right) continue;
    // Extreme of the parabola through three values, with a margin of a tenth for its error.
    const double rise = -(right + left) * (right + left) / (8.0 * (right - left));
    const double turn = value[i] + 1.1 * rise;
    if (turn >= range.least && turn <= range.greatest) continue;
    const double guess = x[i] - 0.5 * (x[i + 1] - x[i]) * (right + left) / (right - left);
    const double at = Slope(path.a, path.degree).zero_from(guess, x[i - 1], x[i + 1]);
    const double there = motion::value_at(path.a, path.degree, at);
    // If the Newton steps have converged to another extreme, record the sample x[i] instead.
    record(path, place, (left > right ? there >= value[i] : there <= value[i]) ? at : x[i]);
  }
  find_near_end(sample_intervals, path, place, x, value, ends);
}

}  // namespace signorini::events
