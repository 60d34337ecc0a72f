#include "sensitivity/oscillator_pairs.hpp"

#include <algorithm>

#include "base/rounding.hpp"

namespace signorini::sensitivity {
namespace {

// slow_square: largest m t^2 for which a pair is computed as a series in m t^2. turning_square: m t^2 above which a mode
// oscillates. If one of two modes does not oscillate and the other one is not slow, their l differ by at least a quarter of
// the larger one, because l t^2 <= 4.1 for the first mode and l t^2 > 6 for the second.
constexpr double slow_square = 6.0, turning_square = 0.09;
constexpr int max_time_terms = 64;    // 40 terms are sufficient for l t^2 <= 1 and alpha t <= 4
constexpr int max_series_terms = 24;  // 6^24 / 48! = 4e-43
// Largest x for the series of sin(x)/x with seven terms, whose error is 0.36^14/15! = 5e-19.
constexpr double small_angle = 0.25;

double sine_of(double a) { return std::sin(a); }
double cosine_of(double a) { return std::cos(a); }
modal::Complex sine_of(modal::Complex a) {
  return {std::sin(a.re) * std::cosh(a.im), std::cos(a.re) * std::sinh(a.im)};
}
modal::Complex cosine_of(modal::Complex a) {
  return {std::cos(a.re) * std::cosh(a.im), -std::sin(a.re) * std::sinh(a.im)};
}
double square_root(double a) { return std::sqrt(a); }
modal::Complex square_root(modal::Complex a) { return modal::complex_sqrt(a); }

double largest(double a) { return std::abs(a); }
double largest(modal::Complex a) { return std::max(std::abs(a.re), std::abs(a.im)); }

bool turns(double m, double square) { return m * square > turning_square; }
bool turns(modal::Complex m, double square) { return modal::size_of(m) * square > turning_square; }

template <class S>
S sine_over(S x, S sine) {
  if (largest(x) > small_angle) return sine * modal::inverse(x);
  const S y = x * x;
  S sum(1.0);
  for (int j = 7; j >= 1; --j) sum = S(1.0) - y * sum * (1.0 / (2.0 * j * (2.0 * j + 1.0)));
  return sum;
}

}  // namespace

template <class S>
void OscillatorPairs<S>::fill_turning(std::size_t k) {
  const S w = square_root(m_[k]), half = w * (0.5 * t_);
  w_[k] = w;
  inverse_w_[k] = modal::inverse(w);
  half_sine_[k] = sine_of(half);
  half_cosine_[k] = cosine_of(half);
  sine_[k] = half_sine_[k] * half_cosine_[k] * 2.0;
  cosine_[k] = half_cosine_[k] * half_cosine_[k] - half_sine_[k] * half_sine_[k];
  s_[k] = sine_[k] * inverse_w_[k] * decay_;
  c_[k] = cosine_[k] * decay_ + s_[k] * (0.5 * alpha_);
}

/// C and S of two slow modes, from the series
/// cos(sqrt(m) t) = sum (-m t^2)^j / (2j)!,  sin(sqrt(m) t)/sqrt(m) = t sum (-m t^2)^j / (2j + 1)!
/// with the powers x^j[k, l] = x_k x^(j-1)[k, l] + x_l^(j-1), where x = -m t^2.
template <class S>
typename OscillatorPairs<S>::Both OscillatorPairs<S>::near_zero(std::size_t k, std::size_t l) const {
  const S x = m_[k] * (-t_ * t_), y = m_[l] * (-t_ * t_);
  S power(0.0), last(1.0);  // x^j[k, l] and y^j
  S cosine(0.0), sine(0.0);
  double factorial = 1.0;
  const double greatest = 1.5 * std::max(largest(x), largest(y));
  double bound = 1.0;  // j greatest^(j-1)
  for (int j = 1; j < max_series_terms; ++j) {
    power = x * power + last;
    last = last * y;
    factorial /= (2.0 * j) * (2.0 * j - 1.0);
    cosine += power * factorial;
    sine += power * (factorial / (2.0 * j + 1.0));
    if (bound * (j + 1) * factorial <= 1e-3 * rounding::eps && j > 1) break;
    bound *= greatest;
  }
  const double step = -t_ * t_ * decay_;
  const S s = sine * (step * t_);
  return {cosine * step + s * (0.5 * alpha_), s};
}

/// C and S of two modes that oscillate, from
/// cos[k, l] = - t/(w_k + w_l) sin(a) sin(d)/d,   sin[k, l] = t/(w_k + w_l) cos(a) sin(d)/d,
/// a = (w_k + w_l) t/2,  d = (w_k - w_l) t/2
template <class S>
typename OscillatorPairs<S>::Both OscillatorPairs<S>::turning(std::size_t k, std::size_t l) const {
  const S sum = modal::inverse(w_[k] + w_[l]);
  const S d = (m_[k] - m_[l]) * sum * (0.5 * t_);
  const S p = half_sine_[k] * half_cosine_[l], q = half_cosine_[k] * half_sine_[l];
  const S over = sine_over(d, p - q) * sum * t_;
  const S cosine = -((p + q) * over);
  const S turn = (half_cosine_[k] * half_cosine_[l] - half_sine_[k] * half_sine_[l]) * over;
  const S s = (turn - sine_[l] * inverse_w_[l] * sum) * inverse_w_[k] * decay_;
  return {cosine * decay_ + s * (0.5 * alpha_), s};
}

/// C and S of two modes whose l are clearly different, from the definition.
template <class S>
typename OscillatorPairs<S>::Both OscillatorPairs<S>::apart(std::size_t k, std::size_t l) const {
  const S over = modal::inverse(m_[k] - m_[l]);
  return {(c_[k] - c_[l]) * over, (s_[k] - s_[l]) * over};
}

template <class S>
void OscillatorPairs<S>::fill(const std::vector<S>& l, double alpha, double t) {
  const std::size_t n = l.size();
  const double square = t * t;
  l_ = l;
  alpha_ = alpha;
  t_ = t;
  decay_ = std::exp(-0.5 * alpha * t);
  m_.resize(n);
  for (std::vector<S>* list : {&w_, &inverse_w_, &sine_, &cosine_, &half_sine_, &half_cosine_, &c_, &s_})
    list->assign(n, S(0.0));
  turns_.assign(n, 0);
  slow_.assign(n, 0);
  h_.clear();
  columns_.clear();
  for (std::size_t k = 0; k < n; ++k) {
    m_[k] = l[k] - S(0.25 * alpha * alpha);
    turns_[k] = turns(m_[k], square) ? 1 : 0;
    slow_[k] = modal::size_of(m_[k]) * square <= slow_square ? 1 : 0;
    if (turns_[k] != 0) {
      fill_turning(k);
      continue;
    }
    S term(1.0), cosine(1.0), sine(1.0);
    for (int j = 1; j < max_series_terms; ++j) {
      term = term * m_[k] * (-square / ((2.0 * j) * (2.0 * j - 1.0)));
      cosine += term;
      sine += term * (1.0 / (2.0 * j + 1.0));
    }
    s_[k] = sine * (t * decay_);
    c_[k] = cosine * decay_ + s_[k] * (0.5 * alpha);
  }
  for (std::size_t k = 0; k < n; ++k) h_.push_back(h_of(k));
  big_c_.resize(n * n);
  big_s_.resize(n * n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j <= k; ++j) {
      const Both both = (turns_[k] & turns_[j]) != 0 ? turning(k, j)
                        : (slow_[k] & slow_[j]) != 0 ? near_zero(k, j)
                                                     : apart(k, j);
      big_c_[k * n + j] = big_c_[j * n + k] = both.c;
      big_s_[k * n + j] = big_s_[j * n + k] = both.s;
    }
}

/// h of mode k, from l h = 1 - c, or by a series in time if l t^2 is small.
template <class S>
S OscillatorPairs<S>::h_of(std::size_t k) const {
  const double square = t_ * t_;
  if (modal::size_of(l_[k]) * square > 1.0) return (S(1.0) - c_[k]) * modal::inverse(l_[k]);
  S a(0.0), b(0.0), sum(0.0), force(square);  // coefficients j and j + 1
  for (int j = 0; j < max_time_terms; ++j) {
    const S next =
        (force - a * l_[k] * square) * (1.0 / ((j + 1.0) * (j + 2.0))) - b * (alpha_ * t_ / (j + 2.0));
    force = S(0.0);
    sum += next;
    if (j > 2 && largest(next) + largest(b) <= 1e-3 * rounding::eps * largest(sum)) break;
    a = b;
    b = next;
  }
  return sum;
}

/// H[k, l], from l_k H = -(C + h(l_l)) where l_k is the larger eigenvalue, or by a series in time if both l t^2 are small.
template <class S>
S OscillatorPairs<S>::h_pair(std::size_t k, std::size_t l) const {
  const double square = t_ * t_;
  if (largest(l_[k]) < largest(l_[l])) std::swap(k, l);
  if (modal::size_of(l_[k]) * square > 1.0) return -((C_row(k)[l] + h_[l]) * modal::inverse(l_[k]));
  S y0(0.0), y1(0.0), w0(0.0), w1(0.0), sum(0.0), force(square);  // coefficients j and j + 1
  for (int j = 0; j < max_time_terms; ++j) {
    const double pull = 1.0 / ((j + 1.0) * (j + 2.0)), drag = alpha_ * t_ / (j + 2.0);
    const S y2 = (force - y0 * l_[l] * square) * pull - y1 * drag;
    const S w2 = (w0 * l_[k] + y0) * (-square * pull) - w1 * drag;
    force = S(0.0);
    sum += w2;
    if (j > 4 && largest(w2) + largest(w1) + square * largest(y2) <= 1e-3 * rounding::eps * largest(sum))
      break;
    y0 = y1;
    y1 = y2;
    w0 = w1;
    w1 = w2;
  }
  return sum;
}

template <class S>
const std::vector<S>& OscillatorPairs<S>::H_column(std::size_t l) {
  if (const auto known = columns_.find(l); known != columns_.end()) return known->second;
  std::vector<S>& column = columns_[l];
  for (std::size_t k = 0; k < l_.size(); ++k) column.push_back(h_pair(k, l));
  return column;
}

template class OscillatorPairs<double>;
template class OscillatorPairs<modal::Complex>;

}  // namespace signorini::sensitivity
