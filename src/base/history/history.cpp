#include "signorini/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/history/pieces.hpp"
#include "base/rounding.hpp"

namespace signorini {
namespace {

bool has_sine(const Piece& p) { return p.amplitude != 0.0; }

/// Degree of the polynomial part of a piece; -1 if the polynomial is zero.
int degree(const Piece& p) {
  for (std::size_t j = p.coefficients.size(); j > 0; --j)
    if (p.coefficients[j - 1] != 0.0) return static_cast<int>(j) - 1;
  return -1;
}

bool is_constant_piece(const Piece& p) {
  return !p.function && degree(p) <= 0 && (!has_sine(p) || p.omega == 0.0);
}

/// Derivative of the given order of sum_r b_r F^(r)(s (t - t0)) with respect to t.
double of_function(const Piece& p, double t, int order) {
  double sum = 0.0, factor = 1.0;
  for (std::size_t r = 0; r < p.rates.size(); ++r)
    if (p.rates[r] != 0.0)
      sum += p.rates[r] * p.function(p.time_scale * (t - p.origin), order + static_cast<int>(r));
  for (int i = 0; i < order; ++i) factor *= p.time_scale;
  return factor * sum;
}

/// Antiderivative of a piece. For the sine: int a sin(w s + phi) ds = (a/w) sin(w s + phi - pi/2).
Piece antiderivative(const Piece& p) {
  if (p.function)
    throw std::invalid_argument("History: a user-defined function has no integral in closed form");
  Piece q;
  q.origin = p.origin;
  q.coefficients.assign(p.coefficients.size() + 1, 0.0);
  for (std::size_t j = 0; j < p.coefficients.size(); ++j)
    q.coefficients[j + 1] = p.coefficients[j] / static_cast<double>(j + 1);
  if (!has_sine(p)) return q;
  if (p.omega == 0.0) {
    q.coefficients.resize(std::max<std::size_t>(q.coefficients.size(), 2), 0.0);
    q.coefficients[1] += p.amplitude * std::sin(p.phase);
    return q;
  }
  q.amplitude = p.amplitude / p.omega;
  q.omega = p.omega;
  q.phase = p.phase - std::numbers::pi / 2.0;
  return q;
}

/// The piece c0 p + c1 p' + c2 p''.
Piece with_rates_of(const Piece& p, double c0, double c1, double c2) {
  Piece q = p;
  const std::size_t n = p.coefficients.size();
  for (std::size_t j = 0; j < n; ++j) {
    const auto next = static_cast<double>(j + 1);
    q.coefficients[j] = c0 * p.coefficients[j];
    if (j + 1 < n) q.coefficients[j] += c1 * next * p.coefficients[j + 1];
    if (j + 2 < n) q.coefficients[j] += c2 * next * (next + 1.0) * p.coefficients[j + 2];
  }
  // (c0 - c2 w^2) sin x + c1 w cos x = r sin(x + d)
  const double along = c0 - c2 * p.omega * p.omega, across = c1 * p.omega;
  if (across == 0.0) {
    q.amplitude = along * p.amplitude;
  } else {
    q.amplitude = std::hypot(along, across) * p.amplitude;
    q.phase = p.phase + std::atan2(across, along);
  }
  if (!p.function) return q;
  q.rates.assign(p.rates.size() + 2, 0.0);
  for (std::size_t r = 0; r < p.rates.size(); ++r) {
    q.rates[r] += c0 * p.rates[r];
    q.rates[r + 1] += c1 * p.time_scale * p.rates[r];
    q.rates[r + 2] += c2 * p.time_scale * p.time_scale * p.rates[r];
  }
  return q;
}

}  // namespace

void Piece::taylor(double t, double scale, std::size_t count, double* out) const {
  std::fill(out, out + count, 0.0);
  const double s = t - origin;
  double power = 1.0;  // scale^k
  for (std::size_t k = 0; k < std::min(count, coefficients.size()); ++k, power *= scale) {
    double sum = 0.0;
    for (std::size_t j = coefficients.size(); j > k; --j) {
      double binomial = 1.0;
      for (std::size_t i = 1; i <= k; ++i) binomial *= static_cast<double>(j - i) / static_cast<double>(i);
      sum = sum * s + binomial * coefficients[j - 1];
    }
    out[k] = sum * power;
  }
  if (function) {
    double factor = 1.0;  // scale^k / k!
    for (std::size_t k = 0; k < count; ++k) {
      out[k] += factor * of_function(*this, t, static_cast<int>(k));
      factor *= scale / static_cast<double>(k + 1);
    }
  }
  if (amplitude == 0.0) return;
  const double sine = std::sin(omega * s + phase), cosine = std::cos(omega * s + phase);
  double factor = amplitude;  // a (w scale)^k / k!
  for (std::size_t k = 0; k < count; ++k) {
    const double turned = k % 4 == 0 ? sine : k % 4 == 1 ? cosine : k % 4 == 2 ? -sine : -cosine;
    out[k] += factor * turned;
    factor *= omega * scale / static_cast<double>(k + 1);
  }
}

double Piece::value(double t, int order) const {
  const double s = t - origin;
  const auto k = static_cast<std::size_t>(order);
  double sum = 0.0;
  for (std::size_t j = coefficients.size(); j > k; --j) {
    double c = coefficients[j - 1];
    for (std::size_t i = 0; i < k; ++i) c *= static_cast<double>(j - 1 - i);
    sum = sum * s + c;
  }
  if (function) sum += of_function(*this, t, order);
  if (amplitude == 0.0) return sum;
  const double angle = omega * s + phase;
  double sine = (order % 2 == 0) ? std::sin(angle) : std::cos(angle);
  if (order % 4 >= 2) sine = -sine;
  for (int i = 0; i < order; ++i) sine *= omega;
  return sum + amplitude * sine;
}

}  // namespace signorini

namespace signorini::history {

double roundoff(const Piece& piece, double t) {
  const double s = std::abs(t - piece.origin);
  double size = 0.0, slope = 0.0, power = 1.0, lower = 0.0;
  for (std::size_t j = 0; j < piece.coefficients.size(); ++j) {
    const double c = std::abs(piece.coefficients[j]);
    size += c * power;
    slope += static_cast<double>(j) * c * lower;
    lower = power;
    power *= s;
  }
  const double a = std::abs(piece.amplitude);
  size += a * (1.0 + std::abs(piece.omega) * s + std::abs(piece.phase));
  slope += a * std::abs(piece.omega);
  if (piece.function) {
    size += std::abs(of_function(piece, t, 0));
    slope += std::abs(of_function(piece, t, 1));
  }
  return rounding::many_operations * (size + (std::abs(t) + std::abs(piece.origin)) * slope);
}

double roundoff_of_rate(const Piece& piece, double t) {
  const double s = std::abs(t - piece.origin);
  double size = 0.0, power = 1.0;
  for (std::size_t j = 1; j < piece.coefficients.size(); ++j, power *= s)
    size += static_cast<double>(j) * std::abs(piece.coefficients[j]) * power;
  size += std::abs(piece.amplitude * piece.omega) * (1.0 + std::abs(piece.omega) * s + std::abs(piece.phase));
  if (piece.function) size += std::abs(of_function(piece, t, 1));
  return rounding::many_operations * size;
}

}  // namespace signorini::history

namespace signorini {

History::History(std::vector<double> starts, std::vector<Piece> pieces)
    : starts_(std::move(starts)), pieces_(std::move(pieces)) {
  if (pieces_.size() != starts_.size() + 1)
    throw std::invalid_argument("History: the number of pieces must be the number of starts plus one");
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (!std::isfinite(starts_[i]) || (i > 0 && starts_[i] <= starts_[i - 1]))
      throw std::invalid_argument("History: the start times must be finite and strictly ascending");
}

History History::constant(double value) {
  Piece piece;
  if (value != 0.0) piece.coefficients = {value};
  return History(piece);
}

const Piece& History::piece(double t) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), t);
  return pieces_[static_cast<std::size_t>(next - starts_.begin())];
}

const Piece& History::piece_before(double t) const {
  const auto next = std::lower_bound(starts_.begin(), starts_.end(), t);
  return pieces_[static_cast<std::size_t>(next - starts_.begin())];
}

std::vector<Breakpoint> History::breakpoints() const {
  std::vector<Breakpoint> result;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const double t = starts_[i];
    const Piece &left = pieces_[i], &right = pieces_[i + 1];
    const double change = std::abs(right.value(t) - left.value(t));
    // Between equal constant pieces, as in a load of amplitude zero, there is no breakpoint.
    if (change == 0.0 && is_constant_piece(left) && is_constant_piece(right)) continue;
    result.push_back({t, change > history::roundoff(left, t) + history::roundoff(right, t)});
  }
  return result;
}

History History::scaled(double factor, double offset) const {
  History result = *this;
  for (Piece& p : result.pieces_) {
    for (double& c : p.coefficients) c *= factor;
    p.amplitude *= factor;
    for (double& rate : p.rates) rate *= factor;
    if (offset == 0.0) continue;
    if (p.coefficients.empty()) p.coefficients.push_back(0.0);
    p.coefficients[0] += offset;
  }
  return result;
}

History History::integrated() const {
  History result = *this;
  for (Piece& p : result.pieces_) p = antiderivative(p);
  auto shift = [](Piece& p, double t, double target) {
    const double by = target - p.value(t);
    if (by != 0.0) p.coefficients[0] += by;
  };
  auto& pieces = result.pieces_;
  const auto first =
      static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), 0.0) - starts_.begin());
  shift(pieces[first], 0.0, 0.0);
  for (std::size_t i = first; i < starts_.size(); ++i)
    shift(pieces[i + 1], starts_[i], pieces[i].value(starts_[i]));
  for (std::size_t i = first; i > 0; --i)
    shift(pieces[i - 1], starts_[i - 1], pieces[i].value(starts_[i - 1]));
  return result;
}

History History::with_rates(double c0, double c1, double c2) const {
  History result = *this;
  for (Piece& p : result.pieces_) p = with_rates_of(p, c0, c1, c2);
  return result;
}

History History::shifted(double dt) const {
  std::vector<double> starts = starts_;
  std::vector<Piece> pieces = pieces_;
  for (double& t : starts) t += dt;
  for (Piece& p : pieces) p.origin += dt;
  return {std::move(starts), std::move(pieces)};
}

History History::then(double t, const History& next) const {
  std::vector<double> starts;
  std::vector<Piece> pieces{pieces_.front()};
  for (std::size_t i = 0; i < starts_.size() && starts_[i] < t; ++i) {
    starts.push_back(starts_[i]);
    pieces.push_back(pieces_[i + 1]);
  }
  starts.push_back(t);
  pieces.push_back(next.piece(t));
  for (std::size_t i = 0; i < next.starts_.size(); ++i)
    if (next.starts_[i] > t) {
      starts.push_back(next.starts_[i]);
      pieces.push_back(next.pieces_[i + 1]);
    }
  return {std::move(starts), std::move(pieces)};
}

History History::repeated(double from, double period, int rounds) const {
  std::vector<double> starts;
  std::vector<Piece> pieces{pieces_.front()};
  const auto add = [&](double start, Piece piece, double dt) {
    piece.origin += dt;
    starts.push_back(start);
    pieces.push_back(std::move(piece));
  };
  for (std::size_t i = 0; i < starts_.size() && starts_[i] < from; ++i) add(starts_[i], pieces_[i + 1], 0.0);
  // Starts at the end of a round are omitted, because the next round starts there. The margin covers the rounding of
  // from + period.
  const double end = from + period - rounding::many_operations * (std::abs(from) + rounds * period);
  for (int round = 0; round < rounds; ++round) {
    const double dt = round * period;
    add(from + dt, piece(from), dt);
    for (std::size_t i = 0; i < starts_.size(); ++i)
      if (starts_[i] > from && starts_[i] < end) add(starts_[i] + dt, pieces_[i + 1], dt);
  }
  const double last = from + rounds * period;
  add(last, piece(last), 0.0);
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (starts_[i] > last) add(starts_[i], pieces_[i + 1], 0.0);
  return {std::move(starts), std::move(pieces)};
}

bool History::is_constant() const {
  const double value = pieces_.front().value(0.0);
  return std::all_of(pieces_.begin(), pieces_.end(),
                     [&](const Piece& p) { return is_constant_piece(p) && p.value(0.0) == value; });
}

bool History::has_closed_form() const {
  return std::none_of(pieces_.begin(), pieces_.end(), [](const Piece& p) { return bool(p.function); });
}

// Lower bound of a piece for find_negative_time(), from a Taylor expansion about m:
//
//   f(t) >= f(m) - sum_{0<k<K} |f^(k)(m)| r^k / k! - |a| (w r)^K / K!     for |t - m| <= r,  K > degree
//
// If the bound is not negative, f is not negative in the interval |t - m| <= r; other intervals are halved. User-defined
// functions are sampled instead.

namespace {

// Number of samples per piece of a user-defined function. Chosen value, finer than the details of practical loads.
constexpr int samples_of_functions = 4096;

/// Calls visit(piece, from, to) for the part of every piece within [0, t_end].
template <class Visit>
void each_part(const History& f, double t_end, const Visit& visit) {
  const auto& starts = f.starts();
  for (std::size_t i = 0; i < f.pieces().size(); ++i) {
    const double from = i == 0 ? 0.0 : std::max(0.0, starts[i - 1]);
    const double to = i == starts.size() ? t_end : std::min(t_end, starts[i]);
    if (from <= to) visit(f.pieces()[i], from, to);
  }
}

bool oscillates(const Piece& p) { return p.amplitude != 0.0 && p.omega != 0.0; }

bool is_constant_and_sine(const Piece& p) {
  return std::all_of(p.coefficients.begin() + std::min<std::ptrdiff_t>(1, std::ssize(p.coefficients)),
                     p.coefficients.end(), [](double c) { return c == 0.0; });
}

bool negative(const Piece& p, double t) { return p.value(t) < -history::roundoff(p, t); }

/// Time of the first minimum of the sine at or after `from`.
double trough(const Piece& p, double from) {
  const double w = std::abs(p.omega);
  const double phase = p.omega > 0.0 ? p.phase : std::numbers::pi - p.phase;
  const double lowest = p.amplitude > 0.0 ? -std::numbers::pi / 2.0 : std::numbers::pi / 2.0;
  const double first = p.origin + (lowest - phase) / w, period = 2.0 * std::numbers::pi / w;
  return first + period * std::ceil((from - first) / period);
}

/// Lower bound of the piece for all times within r of m.
double lower_bound(const Piece& p, double m, double r) {
  constexpr int sine_terms = 6;
  const int terms = std::max(static_cast<int>(p.coefficients.size()), oscillates(p) ? sine_terms : 1);
  double bound = p.value(m), factor = 1.0;
  for (int k = 1; k < terms; ++k) {
    factor *= r / k;
    bound -= std::abs(p.value(m, k)) * factor;
  }
  if (oscillates(p)) bound -= std::abs(p.amplitude) * std::pow(std::abs(p.omega), terms) * factor * r / terms;
  return bound;
}

/// A time in [from, to] at which the piece is negative; -1: there is none.
double search(const Piece& p, double from, double to) {
  const double m = 0.5 * (from + to);
  if (negative(p, m)) return m;
  const double r = std::max(m - from, to - m);
  if (lower_bound(p, m, r) >= -history::roundoff(p, m)) return -1.0;
  // The interval cannot be halved further, because there are no doubles between its ends.
  if (r <= rounding::few_operations * std::max(std::abs(from), std::abs(to))) return -1.0;
  const double left = search(p, from, m);
  return left >= 0.0 ? left : search(p, m, to);
}

double negative_in(const Piece& p, double from, double to) {
  if (negative(p, from)) return from;
  if (p.function) {
    for (int i = 1; i <= samples_of_functions; ++i)
      if (const double t = from + (to - from) * i / samples_of_functions; negative(p, t)) return t;
    return -1.0;
  }
  if (oscillates(p) && is_constant_and_sine(p)) {
    const double t = trough(p, from);
    if (t <= to && negative(p, t)) return t;
    return negative(p, to) ? to : -1.0;
  }
  if (negative(p, to)) return to;
  return from < to ? search(p, from, to) : -1.0;
}

/// Upper estimate of |f| for one piece on [from, to].
double magnitude_between(const Piece& p, double from, double to) {
  double largest = 0.0;
  Piece polynomial = p;
  polynomial.amplitude = 0.0;
  const bool turns = std::abs(p.omega) * (to - from) > std::numbers::pi;
  const int samples = p.function ? samples_of_functions : 64;
  for (int i = 0; i <= samples; ++i) {
    const double t = from + (to - from) * i / samples;
    const double value =
        turns && !p.function ? std::abs(polynomial.value(t)) + std::abs(p.amplitude) : std::abs(p.value(t));
    largest = std::max(largest, value);
  }
  return largest;
}

}  // namespace

}  // namespace signorini

namespace signorini::history {

double magnitude(const History& f, double t_end) {
  double largest = 0.0;
  each_part(f, t_end, [&](const Piece& p, double from, double to) {
    largest = std::max(largest, magnitude_between(p, from, to));
  });
  return largest;
}

double max_impulse(const History& f, double t_end, double width) {
  // Ends of the parts; integral of |f| up to each end; bound of |f| in each part.
  std::vector<double> ends{0.0}, until{0.0}, size;
  each_part(f, t_end + width, [&](const Piece& p, double from, double to) {
    // User-defined functions are not evaluated after the end of the run.
    const double seen = p.function ? std::min(to, t_end) : to;
    size.push_back(from <= seen ? magnitude_between(p, from, seen) : 0.0);
    ends.push_back(to);
    until.push_back(until.back() + size.back() * (to - from));
  });
  const auto integral = [&](double t) {
    if (t <= 0.0) return 0.0;
    const auto next = std::upper_bound(ends.begin(), ends.end(), t);
    if (next == ends.end()) return until.back();
    const auto part = static_cast<std::size_t>(next - ends.begin()) - 1;
    return until[part] + size[part] * (t - ends[part]);
  };
  double greatest = 0.0;  // the interval with the greatest integral begins or ends at an end of a part
  for (const double t : ends)
    greatest = std::max({greatest, integral(t + width) - integral(t), integral(t) - integral(t - width)});
  return greatest;
}

double find_negative_time(const History& f, double t_end) {
  double found = -1.0;
  each_part(f, t_end, [&](const Piece& p, double from, double to) {
    if (found < 0.0) found = negative_in(p, from, to);
  });
  return found;
}

}  // namespace signorini::history
