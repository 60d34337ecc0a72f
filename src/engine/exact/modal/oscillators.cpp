#include "engine/exact/modal/oscillators.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::modal {
namespace {

constexpr double small_turn = 1.0;     // largest l time^2 for which the Taylor series is used
constexpr std::size_t max_terms = 64;  // limit of the terms; alpha time <= 4 and l time^2 <= 1 need 40

Complex cosine(Complex a) { return {std::cos(a.re) * std::cosh(a.im), -std::sin(a.re) * std::sinh(a.im)}; }
Complex sine(Complex a) { return {std::sin(a.re) * std::cosh(a.im), std::cos(a.re) * std::sinh(a.im)}; }
double cosine(double a) { return std::cos(a); }
double sine(double a) { return std::sin(a); }

template <class S>
void by_series(S& z, S& rate, S& integral, S p, S l, double alpha, double time) {
  S a = z, b = rate * time;  // terms j and j + 1 of the series
  S sum = a + b, slope = b, area = a + b * 0.5, force = p * (time * time);
  for (std::size_t j = 0; j < max_terms; ++j) {
    const double down = 1.0 / static_cast<double>(j + 2);
    const S next =
        (force - a * l * (time * time)) * (down / static_cast<double>(j + 1)) - b * (alpha * time * down);
    force = S(0.0);
    sum += next;
    slope += next * static_cast<double>(j + 2);
    area += next * (1.0 / static_cast<double>(j + 3));
    const double size = size_of(next) * static_cast<double>(j + 2) + size_of(b) * static_cast<double>(j + 1);
    a = b;
    b = next;
    if (size <= 1e-3 * rounding::eps * (size_of(slope) + size_of(sum)) && j > 2) break;
  }
  z = sum;
  rate = time > 0.0 ? slope * (1.0 / time) : rate;
  integral = area * time;
}

template <class S>
void in_closed_form(S& z, S& rate, S p, S l, S w, double alpha, double decay, double time) {
  const S still = p * inverse(l), y = z - still;
  const S c = cosine(w * time), s = sine(w * time) * inverse(w);
  const double half = 0.5 * alpha;
  z = still + (y * (c + s * half) + rate * s) * decay;
  rate = (rate * (c - s * half) - y * l * s) * decay;
}

}  // namespace

Oscillators::Oscillators(const Spectrum& spectrum, double alpha)
    : alpha_(alpha), real_(spectrum.real()), pairs_(spectrum.pairs()) {
  for (const double l : real_) {
    const double square = l - 0.25 * alpha * alpha;
    damped_omega_.push_back(square > 0.0 ? std::sqrt(square) : 0.0);
  }
  for (const Complex l : pairs_)
    pair_damped_omega_.push_back(complex_sqrt(l - Complex(0.25 * alpha * alpha)));
}

/// Advances the first `count` real modes by their series, in blocks of eight. The series of a block ends when a majorant of the
/// terms of its fastest mode is negligible.
void Oscillators::slow_by_series(const Amplitudes& p, std::size_t count, double time, ModalPoint& to) const {
  constexpr std::size_t width = 8;
  const double square = time * time;
  for (std::size_t begin = 0; begin < count; begin += width) {
    const std::size_t end = std::min(count, begin + width);
    std::array<double, width> a{}, b{}, l{}, sum{}, slope{}, force{};
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = k - begin;
      a[i] = to.z.real[k];
      b[i] = to.rate.real[k] * time;
      l[i] = real_[k] * square;
      force[i] = p.real[k] * square;
      sum[i] = a[i] + b[i];
      slope[i] = b[i];
    }
    const double most = std::max(std::abs(l[0]), std::abs(l[end - begin - 1]));
    double bound = 1.0, next_bound = 1.0;
    for (std::size_t j = 0; j < max_terms; ++j) {
      const double down = 1.0 / static_cast<double>(j + 2), pull = down / static_cast<double>(j + 1);
      const double drag = alpha_ * time * down;
      for (std::size_t i = 0; i < width; ++i) {
        const double next = (force[i] - a[i] * l[i]) * pull - b[i] * drag;
        force[i] = 0.0;
        sum[i] += next;
        slope[i] += next * static_cast<double>(j + 2);
        a[i] = b[i];
        b[i] = next;
      }
      const double last = bound * most * pull + next_bound * drag;
      bound = next_bound;
      next_bound = last;
      if ((bound + last) * static_cast<double>(j + 2) <= 1e-3 * rounding::eps && j > 2) break;
    }
    for (std::size_t k = begin; k < end; ++k) {
      to.z.real[k] = sum[k - begin];
      if (time > 0.0) to.rate.real[k] = slope[k - begin] / time;
    }
  }
}

void Oscillators::advance(const ModalPoint& from, const Amplitudes& p, double time, ModalPoint& to) const {
  to = from;
  const double decay = std::exp(-0.5 * alpha_ * time), square = time * time;
  const auto turns = [&](std::size_t k) {
    return real_[k] * square > small_turn && damped_omega_[k] * time > 0.5;
  };
  std::size_t first = 0;  // first mode for the closed form; all later modes are faster
  while (first < real_.size() && !turns(first)) ++first;
  slow_by_series(p, first, time, to);
  for (std::size_t k = first; k < real_.size(); ++k)
    in_closed_form(to.z.real[k], to.rate.real[k], p.real[k], real_[k], damped_omega_[k], alpha_, decay, time);
  Complex complex_area;
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (size_of(pairs_[k]) * square > small_turn && size_of(pair_damped_omega_[k]) * time > 0.5)
      in_closed_form(to.z.pair[k], to.rate.pair[k], p.pair[k], pairs_[k], pair_damped_omega_[k], alpha_,
                     decay, time);
    else
      by_series(to.z.pair[k], to.rate.pair[k], complex_area, p.pair[k], pairs_[k], alpha_, time);
}

void Oscillators::amplitudes(const ModalPoint& at, const Amplitudes& p, std::vector<double>& real,
                             std::vector<double>& pair) const {
  real.resize(real_.size());
  for (std::size_t k = 0; k < real_.size(); ++k) {
    const double w = damped_omega_[k];
    if (!(w > 0.0)) {
      real[k] = never;
      continue;
    }
    const double y = at.z.real[k] - p.real[k] / real_[k], b = (at.rate.real[k] + 0.5 * alpha_ * y) / w;
    real[k] = std::sqrt(y * y + b * b);
  }
  pair.resize(pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Complex y = at.z.pair[k] - p.pair[k] * inverse(pairs_[k]);
    pair[k] = size_of(y) + size_of(at.rate.pair[k] + y * (0.5 * alpha_)) / std::sqrt(size_of(pairs_[k]));
  }
}

Amplitudes Oscillators::accelerations(const ModalPoint& at, const Amplitudes& p) const {
  Amplitudes second;
  for (std::size_t k = 0; k < at.z.real.size(); ++k)
    second.real.push_back(p.real[k] - alpha_ * at.rate.real[k] - real_[k] * at.z.real[k]);
  for (std::size_t k = 0; k < at.z.pair.size(); ++k)
    second.pair.push_back(p.pair[k] - at.rate.pair[k] * alpha_ - pairs_[k] * at.z.pair[k]);
  return second;
}

void Oscillators::integrate(const ModalPoint& from, const ModalPoint& to, const Amplitudes& p, double time,
                            Amplitudes& out) const {
  out.real.resize(real_.size());
  out.pair.resize(pairs_.size());
  const double square = time * time;
  const auto one = [&](auto z0, auto r0, auto z1, auto r1, auto force, auto l, auto& result) {
    if (size_of(l) * square > small_turn) {
      result = (force * time - (z1 - z0) * alpha_ - (r1 - r0)) * inverse(l);
    } else {
      by_series(z0, r0, result, force, l, alpha_, time);
    }
  };
  for (std::size_t k = 0; k < real_.size(); ++k)
    one(from.z.real[k], from.rate.real[k], to.z.real[k], to.rate.real[k], p.real[k], real_[k], out.real[k]);
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    one(from.z.pair[k], from.rate.pair[k], to.z.pair[k], to.rate.pair[k], p.pair[k], pairs_[k], out.pair[k]);
}

}  // namespace signorini::modal
