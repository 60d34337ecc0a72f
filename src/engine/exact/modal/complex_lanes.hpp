// complex_lanes.hpp: complex numbers with fast products, and vectorised sums of complex numbers.
//
// std::complex checks products and quotients for infinities, which takes several times as long as the arithmetic. Infinities do
// not occur here. Overloads such as inverse() and size_of() allow the same template code for real and complex numbers.
#pragma once

#include <cmath>
#include <cstddef>

namespace signorini::modal {

template <class R>
struct BasicComplex {
  R re{}, im{};
  BasicComplex() = default;
  BasicComplex(R real, R imaginary = R(0)) : re(real), im(imaginary) {}  // NOLINT: a real is a complex number

  BasicComplex& operator+=(BasicComplex b) { return *this = {re + b.re, im + b.im}; }
  BasicComplex& operator-=(BasicComplex b) { return *this = {re - b.re, im - b.im}; }
  BasicComplex& operator*=(BasicComplex b) { return *this = {re * b.re - im * b.im, re * b.im + im * b.re}; }
  BasicComplex& operator*=(R b) { return *this = {re * b, im * b}; }
  friend BasicComplex operator+(BasicComplex a, BasicComplex b) { return a += b; }
  friend BasicComplex operator-(BasicComplex a, BasicComplex b) { return a -= b; }
  friend BasicComplex operator-(BasicComplex a) { return {-a.re, -a.im}; }
  friend BasicComplex operator*(BasicComplex a, BasicComplex b) { return a *= b; }
  friend BasicComplex operator*(BasicComplex a, R b) { return a *= b; }
  friend BasicComplex operator*(R a, BasicComplex b) { return b *= a; }
};
using Complex = BasicComplex<double>;
using WideComplex = BasicComplex<long double>;

[[nodiscard]] inline double inverse(double a) { return 1.0 / a; }
[[nodiscard]] inline long double inverse(long double a) { return 1.0L / a; }
template <class R>
[[nodiscard]] BasicComplex<R> inverse(BasicComplex<R> a) {
  const R factor = R(1) / (a.re * a.re + a.im * a.im);
  return {a.re * factor, -a.im * factor};
}
[[nodiscard]] inline Complex operator/(Complex a, Complex b) { return a * inverse(b); }
[[nodiscard]] inline double size_of(double a) { return std::abs(a); }
[[nodiscard]] inline long double size_of(long double a) { return std::abs(a); }
template <class R>
[[nodiscard]] R size_of(BasicComplex<R> a) {
  constexpr R least = R(1e-250), most = R(1e250);  // a square in this range has all digits; hypot is slower
  const R square = a.re * a.re + a.im * a.im;
  return square > least && square < most ? std::sqrt(square) : std::hypot(a.re, a.im);
}
[[nodiscard]] inline bool is_zero(double a) { return a == 0.0; }
[[nodiscard]] inline bool is_zero(Complex a) { return a.re == 0.0 && a.im == 0.0; }
[[nodiscard]] inline double real_part(double a) { return a; }
[[nodiscard]] inline double real_part(Complex a) { return a.re; }
/// Contribution of a mode to a real quantity: its real term a, or the sum of a complex term and its conjugate.
[[nodiscard]] inline double real_contribution(double a) { return a; }
[[nodiscard]] inline double real_contribution(Complex a) { return 2.0 * a.re; }
[[nodiscard]] inline Complex complex_sqrt(Complex a) {
  const double size = std::hypot(a.re, a.im);
  const double re = std::sqrt(0.5 * (size + std::abs(a.re)));
  if (re == 0.0) return {};
  const double im = 0.5 * std::abs(a.im) / re;
  return a.re >= 0.0 ? Complex{re, a.im >= 0.0 ? im : -im} : Complex{im, a.im >= 0.0 ? re : -re};
}

// Sums over the poles D_i of a spectrum, for one value l = (pole `home`) + own.
//
//   one_i = 1/(l - D_i),   two_i = one_i^2,   sum_i one_i w_i,   sum_i two_i w_i
//
// Real and imaginary parts are in separate arrays. Every sum is computed as four partial sums, so that the loop is vectorised.

/// Writes 1/(l - D_i), i < n, to re and im. base + tiny: the poles D_i; home_base + home_tiny: the pole `home`.
void inverse_distances(const double* base, const double* tiny, std::ptrdiff_t n, double home_base,
                       double home_tiny, const Complex& own, double* re, double* im);
/// Writes the squares of n complex numbers.
void square_all(const double* re, const double* im, std::ptrdiff_t n, double* square_re, double* square_im);
/// Returns the sum of (re_i + sqrt(-1) im_i) w_i.
[[nodiscard]] Complex weighted_sum(const double* re, const double* im, const double* w, std::ptrdiff_t n);
/// Writes out_i = sum_a small_a side_ia / (D_i - l) for real l. side: n x rank, stored by columns.
void cauchy_vector(const double* base, const double* tiny, std::ptrdiff_t n, double home_base,
                   double home_tiny, double own, const double* small, const double* side, std::ptrdiff_t rank,
                   double* out);
/// Returns the sum of re_i + sqrt(-1) im_i.
[[nodiscard]] Complex complex_sum(const double* re, const double* im, std::ptrdiff_t n);

}  // namespace signorini::modal
