#include "sensitivity/oscillator_pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <complex>

using namespace signorini;

namespace {

using Wide = std::complex<long double>;

/// y(t) of y'' + alpha y' + l y = p from z and r, in extended precision.
Wide closed_form_motion(Wide l, long double alpha, long double t, Wide z, Wide r, Wide p) {
  const Wide w = std::sqrt(l - 0.25L * alpha * alpha);
  const Wide s = std::exp(-0.5L * alpha * t) * (std::abs(w) > 0.0L ? std::sin(w * t) / w : Wide(t));
  const Wide c = std::exp(-0.5L * alpha * t) * std::cos(w * t) + 0.5L * alpha * s;
  Wide h = (1.0L - c) / l;
  if (std::abs(l) * t * t < 1e-3L) {  // h = int s
    Wide a = 0.0L, b = 0.0L, force = t * t;
    h = 0.0L;
    for (int j = 0; j < 40; ++j) {
      const Wide next = (force - a * l * t * t) / ((j + 1.0L) * (j + 2.0L)) - b * (alpha * t / (j + 2.0L));
      force = 0.0L;
      h += next;
      a = b;
      b = next;
    }
  }
  return z * c + r * s + p * h;
}

/// (y(k) - y(l))/(k - l), or what it comes to where both are one: an average of differences.
Wide apart(Wide k, Wide l, long double alpha, long double t, Wide z, Wide r, Wide p) {
  const auto difference = [&](Wide a, Wide b) {
    return (closed_form_motion(a, alpha, t, z, r, p) - closed_form_motion(b, alpha, t, z, r, p)) / (a - b);
  };
  const long double size = (1.0L + std::sqrt(std::abs(k)) * t) / (t * t);
  if (std::abs(k - l) > 1e-4L * size) return difference(k, l);
  const Wide m = 0.5L * (k + l), d = 0.5L * (k - l), h = 1e-4L * size;
  // symmetric about the middle: c[m + e, m - e] is even in e, so two widths give the one in between
  const Wide one = difference(m + h, m - h), two = difference(m + 2.0L * h, m - 2.0L * h);
  return one + (two - one) * ((d * d - h * h) / (3.0L * h * h));
}

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/oscillator_pairs");

TEST_CASE("divided differences of oscillators, however near to each other") {
  for (const double alpha : {0.0, 3.0})
    for (const double t : {0.01, 0.3, 1.0}) {
      const std::vector<double> l{0.0, 1e-4, 2.25, 2.26, 5.9, 6.3, 40.0, 40.0 * (1.0 + 1e-7), 900.0, 1e5};
      sensitivity::OscillatorPairs<double> pairs;
      pairs.fill(l, alpha, t);
      for (std::size_t k = 0; k < l.size(); ++k)
        for (std::size_t j = 0; j < l.size(); ++j) {
          CAPTURE(alpha);
          CAPTURE(t);
          CAPTURE(l[k]);
          CAPTURE(l[j]);
          const double scale = t * t / (1.0 + std::max(l[k], l[j]) * t * t);  // of C; S is t times it at most
          const auto expected = [&](double z, double r, double p) {
            return static_cast<double>(apart(l[k], l[j], alpha, t, z, r, p).real());
          };
          CHECK(std::abs(pairs.C_row(k)[j] - expected(1.0, 0.0, 0.0)) <= 1e-10 * scale);
          CHECK(std::abs(pairs.S_row(k)[j] - expected(0.0, 1.0, 0.0)) <= 1e-10 * scale * t);
          CHECK(std::abs(pairs.H_column(j)[k] - expected(0.0, 0.0, 1.0)) <= 1e-9 * scale * t * t);
        }
    }
}

TEST_CASE("modes that come in conjugate pairs") {
  const double alpha = 2.0, t = 0.4;
  const std::vector<modal::Complex> l{modal::Complex(3.0), modal::Complex(50.0, 7.0),
                                      modal::Complex(50.0, -7.0), modal::Complex(50.0, 7.01),
                                      modal::Complex(4000.0)};
  sensitivity::OscillatorPairs<modal::Complex> pairs;
  pairs.fill(l, alpha, t);
  const auto wide = [](modal::Complex a) { return Wide(a.re, a.im); };
  for (std::size_t k = 0; k < l.size(); ++k)
    for (std::size_t j = 0; j < l.size(); ++j) {
      const double scale = t * t / (1.0 + std::max(modal::size_of(l[k]), modal::size_of(l[j])) * t * t);
      const Wide c = apart(wide(l[k]), wide(l[j]), alpha, t, 1.0L, 0.0L, 0.0L);
      const Wide s = apart(wide(l[k]), wide(l[j]), alpha, t, 0.0L, 1.0L, 0.0L);
      CHECK(static_cast<double>(std::abs(wide(pairs.C_row(k)[j]) - c)) <= 1e-9 * scale);
      CHECK(static_cast<double>(std::abs(wide(pairs.S_row(k)[j]) - s)) <= 1e-9 * scale * t);
    }
}
