#include "engine/falls/first_fall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/rounding.hpp"

namespace signorini {
namespace {

constexpr std::size_t size = most_fall_degree + 1;
constexpr double near_root = 1e-6;            // relative: this close, Newton's next step has all digits
constexpr double finest = rounding::of_many;  // width, relative to the whole step
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

/// The only downward zero crossing of p in [lo, hi]: Newton steps, kept inside by bisection.
double only_zero(const double* a, std::size_t degree, double lo, double hi, double guess) {
  double x = guess > lo && guess < hi ? guess : 0.5 * (lo + hi);
  double last = 1.0;  // length of the last step
  for (int i = 0; i < 200; ++i) {
    double value = a[degree], slope = 0.0;
    for (std::size_t k = degree; k-- > 0;) {
      slope = slope * x + value;
      value = value * x + a[k];
    }
    const double newton = value / slope, step = std::abs(newton);
    // Newton's steps shrink quadratically until rounding makes them wander.
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
  Coefficients b;  // only degree + 1 entries are ever set
};

/// Place where the control polygon crosses zero downwards.
double guess(std::size_t n, const Interval& now) {
  std::size_t i = 0;
  while (i < n && now.b[i] > 0.0) ++i;
  if (i == 0) return now.lo;
  const double part = static_cast<double>(i - 1) + now.b[i - 1] / (now.b[i - 1] - now.b[i]);
  return now.lo + (now.hi - now.lo) * part / static_cast<double>(n);
}

/// Halves: `left` becomes the left half, `right` the right one.
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

FirstFall first_fall(const double* a, std::size_t degree, double slack) {
  double rest = 0.0;
  for (std::size_t k = 1; k <= degree; ++k) rest += std::abs(a[k]);
  if (!std::isfinite(a[0]) || !std::isfinite(rest) || !std::isfinite(slack))
    return {FirstFall::Kind::lost};  // a NaN would be halved endlessly
  if (a[0] - rest > slack) return {};

  // Intervals not yet settled, the leftmost on top; each halving leaves one behind.
  std::array<Interval, 64> stack;
  std::size_t count = 1;
  stack[0].lo = 0.0;
  stack[0].hi = 1.0;
  std::fill_n(stack[0].b.begin(), degree + 1, 0.0);
  const double* row = conversion(degree);
  for (std::size_t k = 0; k <= degree; row += degree + 1 - k, ++k)
    for (std::size_t i = k; i <= degree; ++i) stack[0].b[i] += a[k] * row[i - k];

  FirstFall result;  // none, or the first touch
  const auto falls_at = [&](double x) { return FirstFall{FirstFall::Kind::fall, x, result.intervals}; };
  const auto touch = [&](double x) {
    if (result.kind == FirstFall::Kind::none) result = {FirstFall::Kind::touch, x, result.intervals};
  };
  while (count > 0) {
    Interval& now = stack[count - 1];
    ++result.intervals;
    std::size_t above = 0, below = 0, rises = 0, falls = 0;
    bool one_change = true;  // from above slack to below -slack, none between
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
    if (below == degree + 1) return falls_at(now.lo);
    one_change = one_change && above + below == degree + 1 && now.b[0] > slack;
    if (one_change) return falls_at(only_zero(a, degree, now.lo, now.hi, guess(degree, now)));
    if (rises == degree) {  // monotone: the values at its ends decide
      if (now.b[0] < -slack) return falls_at(now.lo);
      if (now.b[0] <= slack && now.lo > 0.0) touch(now.lo);
      --count;
      continue;
    }
    if (falls == degree) {
      const double right = now.b[degree];
      if (right < -slack)
        return falls_at(now.b[0] > 0.0 ? only_zero(a, degree, now.lo, now.hi, guess(degree, now)) : now.lo);
      // At the end of the step the next step decides whether it falls.
      if (right <= slack && now.hi < 1.0) touch(now.hi);
      --count;
      continue;
    }
    if (now.hi - now.lo <= finest) {
      if (now.b[0] <= slack) touch(now.lo);
      --count;
      continue;
    }
    // The right half stays below on the stack, the left half goes on top.
    Interval& left = stack[count++];
    left.lo = now.lo;
    left.hi = now.hi;
    std::copy_n(now.b.begin(), degree + 1, left.b.begin());
    halve(degree, left, now);
  }
  return result;
}

}  // namespace signorini
