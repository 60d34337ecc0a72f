// Magnitude of a history, and whether it ever becomes negative.
//
//   f(t) >= f(m) - sum_{0<k<K} |f^(k)(m)| r^k / k! - |a| (w r)^K / K!     for |t - m| <= r,  K > degree
//
// The bound holds for all t in the interval, so an interval with a positive bound is finished; others are halved. Only
// user-defined functions are sampled.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/history/history_internal.hpp"

#include "base/rounding.hpp"

namespace signorini {
namespace {

constexpr int samples_of_functions = 4096;  // per piece; chosen value: finer than the details of practical
                                            // loads

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

bool negative(const Piece& p, double t) { return p.value(t) < -roundoff(p, t); }

/// The first trough of the sine at or after `from`.
double trough(const Piece& p, double from) {
  const double w = std::abs(p.omega);
  const double phase = p.omega > 0.0 ? p.phase : std::numbers::pi - p.phase;
  const double lowest = p.amplitude > 0.0 ? -std::numbers::pi / 2.0 : std::numbers::pi / 2.0;
  const double first = p.origin + (lowest - phase) / w, period = 2.0 * std::numbers::pi / w;
  return first + period * std::ceil((from - first) / period);
}

/// Lower bound of the piece within r of m.
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

/// A time in [from, to] at which the piece is negative, or -1.
double search(const Piece& p, double from, double to) {
  const double m = 0.5 * (from + to);
  if (negative(p, m)) return m;
  const double r = std::max(m - from, to - m);
  if (lower_bound(p, m, r) >= -roundoff(p, m)) return -1.0;
  // no numbers between the ends
  if (r <= rounding::of_few * std::max(std::abs(from), std::abs(to))) return -1.0;
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

/// Magnitude of one piece.
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

double magnitude(const History& f, double t_end) {
  double largest = 0.0;
  each_part(f, t_end, [&](const Piece& p, double from, double to) {
    largest = std::max(largest, magnitude_between(p, from, to));
  });
  return largest;
}

double greatest_impulse(const History& f, double t_end, double width) {
  std::vector<double> ends{0.0}, until{0.0}, size;  // ends of parts, integral up to each end, |f| in each
                                                    // part
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
  double greatest = 0.0;  // the interval begins or ends with a part
  for (const double t : ends)
    greatest = std::max({greatest, integral(t + width) - integral(t), integral(t) - integral(t - width)});
  return greatest;
}

double negative_at(const History& f, double t_end) {
  double found = -1.0;
  each_part(f, t_end, [&](const Piece& p, double from, double to) {
    if (found < 0.0) found = negative_in(p, from, to);
  });
  return found;
}

}  // namespace signorini
