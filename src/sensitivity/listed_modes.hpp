// listed_modes.hpp: lists all modes of a state, and square tables of them.
//
//   S double: real modes only;   S Complex: real modes, modes of pairs, and their conjugates
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "engine/exact/modal/spectrum.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// Real amplitudes, then real and imaginary parts of pairs.
inline Vector flat_modes(const Amplitudes& a) {
  const auto n = static_cast<Eigen::Index>(a.real.size()), pairs = static_cast<Eigen::Index>(a.pair.size());
  Vector x(n + 2 * pairs);
  std::copy(a.real.begin(), a.real.end(), x.data());
  for (Eigen::Index k = 0; k < pairs; ++k) {
    x[n + k] = a.pair[static_cast<std::size_t>(k)].re;
    x[n + pairs + k] = a.pair[static_cast<std::size_t>(k)].im;
  }
  return x;
}

inline Complex conjugate(Complex a) { return {a.re, -a.im}; }

/// Converts a number to the given type.
template <class T>
T of_kind(double a) {
  return T(a);
}
template <class T>
T of_kind(Complex a) {
  if constexpr (std::is_same_v<T, double>)
    return a.re;
  else
    return a;
}

/// Lists all modes: real ones, pairs, and their conjugates.
inline void list_modes(const Amplitudes& a, std::vector<double>& out) { out = a.real; }
inline void list_modes(const Amplitudes& a, std::vector<Complex>& out) {
  out.assign(a.real.begin(), a.real.end());
  out.insert(out.end(), a.pair.begin(), a.pair.end());
  for (const Complex z : a.pair) out.push_back(conjugate(z));
}
template <class S>
std::vector<S> modes_of(const Amplitudes& a) {
  std::vector<S> out;
  list_modes(a, out);
  return out;
}
inline void add_modes(const std::vector<double>& x, Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k];
}
inline void add_modes(const std::vector<Complex>& x, Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k].re;
  for (std::size_t k = 0; k < a.pair.size(); ++k) a.pair[k] += x[a.real.size() + k];
}
template <class S>
using Square = std::vector<S>;  // rows of N numbers

template <class S>
void add_outer(const std::vector<S>& a, const std::vector<S>& b, double factor, Square<S>& out) {
  if (factor == 0.0) return;
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    const S x = a[k] * factor;
    S* row = out.data() + k * n;
    for (std::size_t l = 0; l < n; ++l) row[l] += x * b[l];
  }
}

/// sum_l x_l y_l, in four independent sums.
template <class S>
S inner(const S* x, const S* y, std::size_t n) {
  S sum[4] = {S(0.0), S(0.0), S(0.0), S(0.0)};
  std::size_t l = 0;
  for (; l + 4 <= n; l += 4)
    for (std::size_t i = 0; i < 4; ++i) sum[i] += x[l + i] * y[l + i];
  for (; l < n; ++l) sum[0] += x[l] * y[l];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

template <class S>
void add_product(const Square<S>& b, const std::vector<S>& x, double factor, std::vector<S>& out) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) out[k] += inner(b.data() + k * n, x.data(), n) * factor;
}

}  // namespace signorini
