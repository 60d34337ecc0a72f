#include "engine/events/first_root.hpp"

#include <gsl/gsl_roots.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "base/rounding.hpp"

namespace signorini::events {
namespace {

constexpr double binomial[max_degree + 1][max_degree + 1] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0},
                                                             {1, 2, 1, 0, 0, 0}, {1, 3, 3, 1, 0, 0},
                                                             {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};

/// Smallest x with p(x) <= 0 on [from, to], for any p.
std::optional<double> first_nonpositive(const Bernstein& p, double from, double to, double resolution) {
  if (p.positive()) return std::nullopt;
  if (!(p.b[0] > 0.0)) return from;  // also for NaN, which would be halved endlessly
  if (to - from <= resolution) return p.b[z(p.degree)] <= 0.0 ? std::optional(to) : std::nullopt;
  Bernstein left, right;
  p.split(0.5, left, right);
  const double middle = 0.5 * (from + to);
  if (const auto x = first_nonpositive(left, from, middle, resolution)) return x;
  return first_nonpositive(right, middle, to, resolution);
}

/// Value at x by de Casteljau's algorithm. The degree is a template parameter, so that the compiler keeps the coefficients in
/// registers.
template <std::size_t degree>
double de_casteljau(std::array<double, max_degree + 1> c, double x) {
#pragma GCC unroll 5
  for (std::size_t r = 1; r <= degree; ++r)
#pragma GCC unroll 5
    for (std::size_t i = 0; i <= degree - r; ++i) c[i] = (1.0 - x) * c[i] + x * c[i + 1];
  return c[0];
}

Bernstein shifted(Bernstein p, double factor, double offset) {
  for (int i = 0; i <= p.degree; ++i) p.b[z(i)] = factor * p.b[z(i)] + offset;
  return p;
}

}  // namespace

Bernstein Bernstein::from_powers(int degree, const std::array<double, max_degree + 1>& a) {
  Bernstein p;
  p.degree = degree;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= i; ++j) p.b[z(i)] += binomial[i][j] / binomial[degree][j] * a[z(j)];
  return p;
}

double Bernstein::value(double x) const {
  switch (degree) {
    case 1:
      return de_casteljau<1>(b, x);
    case 2:
      return de_casteljau<2>(b, x);
    case 3:
      return de_casteljau<3>(b, x);
    case 4:
      return de_casteljau<4>(b, x);
    case 5:
      return de_casteljau<5>(b, x);
    default:
      return b[0];
  }
}

double Bernstein::integral(double x) const {
  Bernstein left, right;
  split(x, left, right);
  double sum = 0.0;
  for (int i = 0; i <= degree; ++i) sum += left.b[z(i)];
  return x * sum / (degree + 1);
}

Bernstein Bernstein::derivative() const {
  Bernstein slope;
  slope.degree = degree > 0 ? degree - 1 : 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(degree); ++i)
    slope.b[i] = static_cast<double>(degree) * (b[i + 1] - b[i]);
  return slope;
}

bool Bernstein::positive() const {
  return std::all_of(b.begin(), b.begin() + degree + 1, [](double c) { return c > 0.0; });
}

bool Bernstein::at_least(double level) const {
  return std::all_of(b.begin(), b.begin() + degree + 1, [&](double c) { return c >= level; });
}

void Bernstein::split(double x, Bernstein& left, Bernstein& right) const {
  left.degree = right.degree = degree;
  std::array<double, max_degree + 1> c = b;
  for (int r = 0; r <= degree; ++r) {
    left.b[z(r)] = c[0];
    right.b[z(degree - r)] = c[z(degree - r)];
    for (int i = 0; i < degree - r; ++i) c[z(i)] = (1.0 - x) * c[z(i)] + x * c[z(i + 1)];
  }
}

std::optional<double> first_upcrossing(const Bernstein& p, double level, double resolution) {
  return first_nonpositive(shifted(p, -1.0, level), 0.0, 1.0, resolution);
}

std::optional<double> first_root(const Bernstein& p, double resolution) {
  return first_nonpositive(p, 0.0, 1.0, resolution);
}

namespace {

constexpr std::size_t size = max_root_degree + 1;
// After a Newton step smaller than near_root * x, the next step gives all digits of the root.
constexpr double near_root = 1e-6;
constexpr double finest = rounding::many_operations;  // width below which no interval is halved
using Coefficients = std::array<double, size>;

/// Factor of a_k in b_i for degree n: C(i,k)/C(n,k), row by row for k = 0 .. n, where i = k .. n.
const double* conversion(std::size_t n) {
  static const auto tables = [] {
    std::array<std::vector<double>, size> all;
    for (std::size_t degree = 0; degree < size; ++degree) {
      std::array<Coefficients, size> rows;
      for (std::size_t i = 0; i <= degree; ++i) {
        double ratio = 1.0;
        for (std::size_t k = 0; k <= i; ++k) {
          rows[k][i] = ratio;
          if (k < degree) ratio *= static_cast<double>(i - k) / static_cast<double>(degree - k);
        }
      }
      for (std::size_t k = 0; k <= degree; ++k)
        all[degree].insert(all[degree].end(), rows[k].begin() + static_cast<std::ptrdiff_t>(k),
                           rows[k].begin() + static_cast<std::ptrdiff_t>(degree + 1));
    }
    return all;
  }();
  return tables[n].data();
}

/// The only downward zero crossing of p in [lo, hi], by Newton's method. Bisection replaces a step that would leave the
/// interval.
double only_zero(const double* a, std::size_t degree, double lo, double hi, double guess) {
  double x = guess > lo && guess < hi ? guess : 0.5 * (lo + hi);
  double last = 1.0;  // length of the last Newton or bisection step
  for (int i = 0; i < 200; ++i) {
    double value = a[degree], slope = 0.0;
    for (std::size_t k = degree; k-- > 0;) {
      slope = slope * x + value;
      value = value * x + a[k];
    }
    const double newton = value / slope, step = std::abs(newton);
    // Newton steps decrease quadratically down to the rounding error: stop if they no longer decrease.
    if (step <= rounding::eps * x || (last < near_root * x && step > 0.25 * last)) return x;
    (value > 0.0 ? lo : hi) = x;
    if (x - newton > lo && x - newton < hi) {
      x -= newton;
      last = step;
    } else {
      x = 0.5 * (lo + hi);
      last = hi - lo;
    }
    if (x == lo || x == hi) return x;
  }
  return x;
}

struct Interval {
  double lo, hi;
  Coefficients b;  // only the first degree + 1 entries are used
};

/// Estimate of the root: place at which the control polygon of the coefficients b crosses zero downwards.
double guess(std::size_t n, const Interval& now) {
  std::size_t i = 0;
  while (i < n && now.b[i] > 0.0) ++i;
  if (i == 0) return now.lo;
  const double part = static_cast<double>(i - 1) + now.b[i - 1] / (now.b[i - 1] - now.b[i]);
  return now.lo + (now.hi - now.lo) * part / static_cast<double>(n);
}

/// Halves the interval in `left`: afterwards `left` contains its left half and `right` its right half.
void halve(std::size_t n, Interval& left, Interval& right) {
  const double middle = 0.5 * (left.lo + left.hi);
  right.lo = middle;
  right.hi = left.hi;
  left.hi = middle;
  Coefficients row;
  std::copy_n(left.b.begin(), n + 1, row.begin());
  right.b[n] = row[n];
  for (std::size_t j = 1; j <= n; ++j) {
    for (std::size_t i = 0; i <= n - j; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    left.b[j] = row[0];
    right.b[n - j] = row[n - j];
  }
}

}  // namespace

FirstRoot first_root(const double* a, std::size_t degree, double slack) {
  double rest = 0.0;
  for (std::size_t k = 1; k <= degree; ++k) rest += std::abs(a[k]);
  if (!std::isfinite(a[0]) || !std::isfinite(rest) || !std::isfinite(slack))
    return {FirstRoot::Kind::not_finite};  // a NaN would be halved endlessly
  if (a[0] - rest > slack) return {};

  // Stack of undecided intervals, the leftmost on top. Each halving adds one interval.
  std::array<Interval, 64> stack;
  std::size_t count = 1;
  stack[0].lo = 0.0;
  stack[0].hi = 1.0;
  std::fill_n(stack[0].b.begin(), degree + 1, 0.0);
  const double* row = conversion(degree);
  for (std::size_t k = 0; k <= degree; row += degree + 1 - k, ++k)
    for (std::size_t i = k; i <= degree; ++i) stack[0].b[i] += a[k] * row[i - k];

  FirstRoot result;  // Kind::none, or the first touch so far
  const auto crossing_at = [&](double x) {
    return FirstRoot{FirstRoot::Kind::crossing, x, result.intervals};
  };
  const auto touch = [&](double x) {
    if (result.kind == FirstRoot::Kind::none) result = {FirstRoot::Kind::touch, x, result.intervals};
  };
  while (count > 0) {
    Interval& now = stack[count - 1];
    ++result.intervals;
    std::size_t above = 0, below = 0, rises = 0, falls = 0;
    bool one_change = true;  // the b_i change sign once, from above slack to below -slack; none is between
    for (std::size_t i = 0; i <= degree; ++i) {
      above += now.b[i] > slack ? 1 : 0;
      below += now.b[i] < -slack ? 1 : 0;
      if (i == 0) continue;
      rises += now.b[i] >= now.b[i - 1] ? 1 : 0;
      falls += now.b[i] <= now.b[i - 1] ? 1 : 0;
      one_change = one_change && (now.b[i - 1] < -slack ? now.b[i] < -slack : true);
    }
    if (above == degree + 1) {
      --count;
      continue;
    }
    if (below == degree + 1) return crossing_at(now.lo);
    one_change = one_change && above + below == degree + 1 && now.b[0] > slack;
    if (one_change) return crossing_at(only_zero(a, degree, now.lo, now.hi, guess(degree, now)));
    if (rises == degree) {  // p is monotone in the interval: the values at the ends decide
      if (now.b[0] < -slack) return crossing_at(now.lo);
      if (now.b[0] <= slack && now.lo > 0.0) touch(now.lo);
      --count;
      continue;
    }
    if (falls == degree) {
      const double right = now.b[degree];
      if (right < -slack)
        return crossing_at(now.b[0] > 0.0 ? only_zero(a, degree, now.lo, now.hi, guess(degree, now))
                                          : now.lo);
      // If the guard is zero at the end of this step, the next step decides whether it crosses zero.
      if (right <= slack && now.hi < 1.0) touch(now.hi);
      --count;
      continue;
    }
    if (now.hi - now.lo <= finest) {
      if (now.b[0] <= slack) touch(now.lo);
      --count;
      continue;
    }
    // The right half replaces the interval on the stack; the left half is put on top.
    Interval& left = stack[count++];
    left.lo = now.lo;
    left.hi = now.hi;
    std::copy_n(now.b.begin(), degree + 1, left.b.begin());
    halve(degree, left, now);
  }
  return result;
}

namespace {

double call(double t, void* f) { return (*static_cast<const std::function<double(double)>*>(f))(t); }

}  // namespace

double root_between(const std::function<double(double)>& f, double lo, double hi, double width) {
  const double first = lo, last = hi, at_first = f(lo), at_last = f(hi);
  // Without a sign change, GSL's Brent solver would end the program.
  if (!(at_first > 0.0)) return first;
  if (at_last > 0.0) return last;
  const std::function<double(double)> known = [&](double t) {
    return t == first ? at_first : t == last ? at_last : f(t);
  };
  gsl_function function{&call, const_cast<std::function<double(double)>*>(&known)};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &function, lo, hi);
  for (int i = 0; i < 100; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    lo = gsl_root_fsolver_x_lower(solver.get());
    hi = gsl_root_fsolver_x_upper(solver.get());
    if (hi - lo <= width) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace signorini::events
