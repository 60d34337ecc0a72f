// smooth.hpp: makes a user-defined function with its derivatives from code that is generic in the number type.
//
//   Function f = smooth([](auto t) { return 3.0 * exp(-t) * sin(t * t); });      f(t, k) = d^k f / dt^k
//
// Arithmetic of truncated Taylor series: x_k = x^(k)(t) / k!, without truncation error up to the highest order.
//   (x y)_k = sum_j x_j y_(k-j),   y = exp x: k y_k = sum_j j x_j y_(k-j),   y = log x: x y' = x'
//   s = sin x, c = cos x: s' = c x', c' = -s x',   y = x^p: x y' = p y x'
// Supported: + - * /, exp, log, sin, cos, sqrt, pow(x, number). Orders up to 11.
// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed., table 13.2.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "signorini/history.hpp"

namespace signorini {

/// A number and its derivatives with respect to t, as Taylor coefficients.
class TaylorNumber {
 public:
  static constexpr std::size_t count = 12;

  TaylorNumber(double constant) { c_[0] = constant; }  // NOLINT: numbers are constants
  /// The variable t itself, at the given value.
  [[nodiscard]] static TaylorNumber variable(double t) {
    TaylorNumber x(t);
    x.c_[1] = 1.0;
    return x;
  }
  /// x_k = x^(k) / k!
  [[nodiscard]] double operator[](std::size_t k) const { return c_[k]; }
  [[nodiscard]] double& operator[](std::size_t k) { return c_[k]; }

  friend TaylorNumber operator-(TaylorNumber x) {
    for (double& c : x.c_) c = -c;
    return x;
  }
  friend TaylorNumber operator+(TaylorNumber x, const TaylorNumber& y) {
    for (std::size_t k = 0; k < count; ++k) x.c_[k] += y.c_[k];
    return x;
  }
  friend TaylorNumber operator-(const TaylorNumber& x, const TaylorNumber& y) { return x + (-y); }
  friend TaylorNumber operator*(const TaylorNumber& x, const TaylorNumber& y) {
    TaylorNumber z(0.0);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t j = 0; j <= k; ++j) z.c_[k] += x.c_[j] * y.c_[k - j];
    return z;
  }
  friend TaylorNumber operator/(const TaylorNumber& x, const TaylorNumber& y) {
    TaylorNumber z(0.0);
    for (std::size_t k = 0; k < count; ++k) {
      double sum = x.c_[k];
      for (std::size_t j = 1; j <= k; ++j) sum -= y.c_[j] * z.c_[k - j];
      z.c_[k] = sum / y.c_[0];
    }
    return z;
  }
  friend TaylorNumber exp(const TaylorNumber& x) {
    TaylorNumber y(std::exp(x.c_[0]));
    for (std::size_t k = 1; k < count; ++k) y.c_[k] = convolution(x, y, k);
    return y;
  }
  friend TaylorNumber log(const TaylorNumber& x) {
    TaylorNumber y(std::log(x.c_[0]));
    for (std::size_t k = 1; k < count; ++k) {
      double sum = static_cast<double>(k) * x.c_[k];
      for (std::size_t j = 1; j < k; ++j) sum -= static_cast<double>(j) * y.c_[j] * x.c_[k - j];
      y.c_[k] = sum / (static_cast<double>(k) * x.c_[0]);
    }
    return y;
  }
  friend TaylorNumber sin(const TaylorNumber& x) { return sin_cos(x)[0]; }
  friend TaylorNumber cos(const TaylorNumber& x) { return sin_cos(x)[1]; }
  friend TaylorNumber pow(const TaylorNumber& x, double p) {
    TaylorNumber y(std::pow(x.c_[0], p));
    for (std::size_t k = 1; k < count; ++k) {
      const auto n = static_cast<double>(k);
      double sum = 0.0;
      for (std::size_t j = 1; j <= k; ++j) {
        const auto i = static_cast<double>(j);
        sum += (p * i - (n - i)) * x.c_[j] * y.c_[k - j];
      }
      y.c_[k] = sum / (n * x.c_[0]);
    }
    return y;
  }
  friend TaylorNumber sqrt(const TaylorNumber& x) { return pow(x, 0.5); }

 private:
  /// sum_j j x_j y_(k-j) / k
  static double convolution(const TaylorNumber& x, const TaylorNumber& y, std::size_t k) {
    double sum = 0.0;
    for (std::size_t j = 1; j <= k; ++j) sum += static_cast<double>(j) * x.c_[j] * y.c_[k - j];
    return sum / static_cast<double>(k);
  }
  static std::array<TaylorNumber, 2> sin_cos(const TaylorNumber& x) {
    TaylorNumber s(std::sin(x.c_[0])), c(std::cos(x.c_[0]));
    for (std::size_t k = 1; k < count; ++k) {
      s.c_[k] = convolution(x, c, k);
      c.c_[k] = -convolution(x, s, k);
    }
    return {s, c};
  }

  std::array<double, count> c_{};
};

/// Makes a Function for History from f. f is called with a TaylorNumber. Derivatives of order TaylorNumber::count and above
/// are returned as 0.
template <class F>
[[nodiscard]] Function smooth(F f) {
  return [f](double t, int order) -> double {
    const auto k = static_cast<std::size_t>(order);
    if (k >= TaylorNumber::count) return 0.0;
    double factorial = 1.0;
    for (std::size_t i = 2; i <= k; ++i) factorial *= static_cast<double>(i);
    return factorial * TaylorNumber(f(TaylorNumber::variable(t)))[k];
  };
}

}  // namespace signorini
