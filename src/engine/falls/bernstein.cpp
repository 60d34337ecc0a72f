#include "engine/falls/bernstein.hpp"

#include <algorithm>

namespace signorini {
namespace {

constexpr double binomial[max_degree + 1][max_degree + 1] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0},
                                                             {1, 2, 1, 0, 0, 0}, {1, 3, 3, 1, 0, 0},
                                                             {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};

/// Smallest x with p(x) <= 0 on [from, to]; no assumption about p.
std::optional<double> first_nonpositive(const Bernstein& p, double from, double to, double resolution) {
  if (p.positive()) return std::nullopt;
  if (!(p.b[0] > 0.0)) return from;  // also for a NaN, which would be halved endlessly
  if (to - from <= resolution) return p.b[z(p.degree)] <= 0.0 ? std::optional(to) : std::nullopt;
  Bernstein left, right;
  p.split(0.5, left, right);
  const double middle = 0.5 * (from + to);
  if (const auto x = first_nonpositive(left, from, middle, resolution)) return x;
  return first_nonpositive(right, middle, to, resolution);
}

/// De Casteljau's means. A degree known at compile time keeps them in registers: stored and reloaded pairs would wait
/// for each other.
template <std::size_t degree>
double by_means(std::array<double, max_degree + 1> c, double x) {
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
      return by_means<1>(b, x);
    case 2:
      return by_means<2>(b, x);
    case 3:
      return by_means<3>(b, x);
    case 4:
      return by_means<4>(b, x);
    case 5:
      return by_means<5>(b, x);
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

std::optional<double> first_reach(const Bernstein& p, double level, double resolution) {
  return first_nonpositive(shifted(p, -1.0, level), 0.0, 1.0, resolution);
}

std::optional<double> first_fall(const Bernstein& p, double resolution) {
  return first_nonpositive(p, 0.0, 1.0, resolution);
}

}  // namespace signorini
