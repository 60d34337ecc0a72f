// plain_complex.hpp: complex numbers whose products are four multiplications.
//
// std::complex must treat infinities in products and quotients, which costs several times the arithmetic;
// here no infinity is meant. The functions at the end let kernels be written once for real and complex
// numbers.
#pragma once

#include <cmath>

namespace signorini {

struct Complex {
  double re = 0.0, im = 0.0;
  Complex() = default;
  Complex(double real, double imaginary = 0.0)
      : re(real), im(imaginary) {}  // NOLINT: a real is a complex number

  Complex& operator+=(Complex b) { return *this = {re + b.re, im + b.im}; }
  Complex& operator-=(Complex b) { return *this = {re - b.re, im - b.im}; }
  Complex& operator*=(Complex b) { return *this = {re * b.re - im * b.im, re * b.im + im * b.re}; }
  Complex& operator*=(double b) { return *this = {re * b, im * b}; }
  friend Complex operator+(Complex a, Complex b) { return a += b; }
  friend Complex operator-(Complex a, Complex b) { return a -= b; }
  friend Complex operator-(Complex a) { return {-a.re, -a.im}; }
  friend Complex operator*(Complex a, Complex b) { return a *= b; }
  friend Complex operator*(Complex a, double b) { return a *= b; }
  friend Complex operator*(double a, Complex b) { return b *= a; }
};

[[nodiscard]] inline double inverse(double a) { return 1.0 / a; }
[[nodiscard]] inline long double inverse(long double a) { return 1.0L / a; }
[[nodiscard]] inline Complex inverse(Complex a) {
  const double factor = 1.0 / (a.re * a.re + a.im * a.im);
  return {a.re * factor, -a.im * factor};
}
[[nodiscard]] inline Complex operator/(Complex a, Complex b) { return a * inverse(b); }
[[nodiscard]] inline double size_of(double a) { return std::abs(a); }
[[nodiscard]] inline long double size_of(long double a) { return std::abs(a); }
[[nodiscard]] inline double size_of(Complex a) { return std::hypot(a.re, a.im); }
[[nodiscard]] inline double real_part(double a) { return a; }
[[nodiscard]] inline double real_part(Complex a) { return a.re; }
/// What a mode adds to a real quantity: itself, or itself and its conjugate.
[[nodiscard]] inline double whole(double a) { return a; }
[[nodiscard]] inline double whole(Complex a) { return 2.0 * a.re; }
[[nodiscard]] inline Complex root_of(Complex a) {
  const double size = std::hypot(a.re, a.im);
  const double re = std::sqrt(0.5 * (size + std::abs(a.re)));
  if (re == 0.0) return {};
  const double im = 0.5 * std::abs(a.im) / re;
  return a.re >= 0.0 ? Complex{re, a.im >= 0.0 ? im : -im} : Complex{im, a.im >= 0.0 ? re : -re};
}

}  // namespace signorini
