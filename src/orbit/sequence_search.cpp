#include "orbit/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini::orbit {
namespace {

// Initial value of guess_error_, and its limits for later guesses. Chosen with 400 test curves, for which the search
// needed 11 positions to reach an interval of 1e-9.
constexpr double first_doubt = 0.2, least_doubt = 1e-3, greatest_doubt = 0.5;

/// Up to three positions x with the lengths d of one stretch. The position nearest to the change is last.
struct StretchHistory {
  std::size_t count = 0;
  std::array<double, 3> x{}, d{};

  /// True if d^2 is closer to linear than d.
  [[nodiscard]] bool grazes() const {
    if (count < 3) return true;
    const double part = (x[2] - x[0]) / (x[1] - x[0]);
    const double of_squares = d[0] * d[0] + part * (d[1] * d[1] - d[0] * d[0]) - d[2] * d[2];
    const double of_values = d[0] + part * (d[1] - d[0]) - d[2];
    return std::abs(of_squares) <= 2.0 * d[2] * std::abs(of_values);
  }
  /// x at which f = d^power is zero: the polynomial x(f) through the last `places` values, by Lagrange.
  [[nodiscard]] double zero(int power, std::size_t places) const {
    double sum = 0.0;
    const auto f = [&](std::size_t k) { return power == 2 ? d[k] * d[k] : d[k]; };
    for (std::size_t i = count - places; i < count; ++i) {
      double weight = 1.0;
      for (std::size_t j = count - places; j < count; ++j)
        if (j != i) weight *= f(j) / (f(j) - f(i));
      sum += weight * x[i];
    }
    return sum;
  }
};

}  // namespace

std::vector<double> stretches_of(const std::vector<Event>& events, double period) {
  std::vector<double> stretches;
  for (std::size_t k = 0; k < events.size(); ++k) {
    const double next = k + 1 == events.size() ? events.front().t + period : events[k + 1].t;
    stretches.push_back((next - events[k].t) / period);
  }
  return stretches;
}

SequenceSearch::SequenceSearch(std::vector<double> at_begin, std::vector<double> at_end, double enough)
    : enough_(enough), guess_error_(first_doubt) {
  sides_[0].push_back({0.0, std::move(at_begin)});
  sides_[1].push_back({1.0, std::move(at_end)});
}

void SequenceSearch::update(double x, bool as_at_begin, std::vector<double> stretches) {
  const std::size_t side = as_at_begin ? 0 : 1;
  bounds_[side] = x;
  std::vector<Place>& places = sides_[side];
  // A further change of the sequence may follow beyond x*; stretches of different sequences cannot be compared.
  if (!places.empty() && places.back().stretches.size() != stretches.size()) places.clear();
  if (!stretches.empty()) places.push_back({x, std::move(stretches)});
}

/// Position at which the first stretch vanishes, among all stretches that decrease and vanish within the bounds; nullopt
/// if there is no such stretch.
std::optional<SequenceSearch::Guess> SequenceSearch::guess_from(const std::vector<Place>& places) const {
  if (places.size() < 2) return std::nullopt;
  const double from = places.back().x;
  // A guess beyond a bound by less than enough_ is moved to the bound.
  const auto inside = [&](double x) { return x > low() - enough_ && x < high() + enough_; };
  std::optional<Guess> nearest;
  for (std::size_t k = 0; k < places.back().stretches.size(); ++k) {
    StretchHistory course;
    course.count = std::min<std::size_t>(3, places.size());
    for (std::size_t i = 0; i < course.count; ++i) {
      const Place& place = places[places.size() - course.count + i];
      course.x[i] = place.x;
      course.d[i] = place.stretches[k];
    }
    const double last = course.d[course.count - 1];
    if (!(last > 0.0 && last < course.d[course.count - 2])) continue;
    const int power = course.grazes() ? 2 : 1;
    double x = course.zero(power, course.count);
    if (!inside(x)) x = course.zero(power, 2);
    if (!inside(x)) continue;
    x = std::clamp(x, low(), high());
    if (!nearest || std::abs(x - from) < std::abs(nearest->x - from)) nearest = Guess{x, from};
  }
  return nearest;
}

double SequenceSearch::next() {
  const double middle = 0.5 * (low() + high());
  const std::optional<Guess> from_begin = guess_from(sides_[0]), from_end = guess_from(sides_[1]);
  std::optional<Guess> guess = from_begin;
  if (from_end && !(guess && guess->x - guess->from <= from_end->from - from_end->x)) guess = from_end;
  const std::optional<Guess> before = std::exchange(guess_, guess);
  if (!guess) return middle;
  // The difference of two successive guesses estimates the error of the earlier guess. Its ratio to the distance of
  // the earlier guess is used for the new guess, too.
  if (!before) guess_error_ = first_doubt;
  if (before && before->x != guess->x)
    guess_error_ =
        std::clamp(std::abs((guess->x - before->x) / (guess->x - before->from)), least_doubt, greatest_doubt);
  const double by = std::max(guess_error_ * std::abs(guess->x - guess->from), 0.5 * enough_);
  const double x = high() - guess->x > guess->x - low() ? guess->x + by : guess->x - by;
  return x > low() && x < high() ? x : middle;
}

}  // namespace signorini::orbit
