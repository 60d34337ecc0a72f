// oscillators.hpp: the motion of uncoupled modes under constant forces, in closed form.
//
//   z'' + alpha z' + l z = p:   z - p/l = e^(-alpha t/2) ( a cos(w t) + b sin(w t) ),   w^2 = l - alpha^2/4
//
// If sqrt(l) t is small, the Taylor series in t is used instead: it is an entire function of l, so that zero
// frequencies and critical damping need no special cases. A mode with a complex l represents itself and its
// conjugate.
#pragma once

#include <cmath>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {

/// The motion at one time: real amplitudes z and their rates, or for complex modes (damped_motion.hpp) their
/// amplitudes y and the time since the segment's beginning.
struct ModalPoint {
  Amplitudes z, rate;
  Eigen::VectorXcd y;
  double time = 0.0;
};

/// Bound on |sum_k x_k A_k| for |x_k| = 1: the root of the sum of squares of A_k if the x_k are orthogonal,
/// otherwise the sum of |A_k|.
class SumOfModes {
 public:
  /// Same meaning as StepFacts::eigenvector_condition.
  explicit SumOfModes(double dependence) : orthogonal_(dependence <= 1.0 + 1e-6) {}
  void add(double amplitude) { sum_ += orthogonal_ ? amplitude * amplitude : amplitude; }
  [[nodiscard]] double value() const { return orthogonal_ ? std::sqrt(sum_) : sum_; }

 private:
  bool orthogonal_;
  double sum_ = 0.0;
};

class Oscillators {
 public:
  Oscillators() = default;
  Oscillators(const Spectrum& spectrum, double alpha);

  [[nodiscard]] double alpha() const { return alpha_; }
  [[nodiscard]] const std::vector<double>& real() const { return real_; }
  [[nodiscard]] const std::vector<Complex>& pairs() const { return pairs_; }
  /// w of real modes; 0 for those that do not oscillate.
  [[nodiscard]] const std::vector<double>& damped_omega() const { return damped_omega_; }
  /// w of pairs: its imaginary part is the growth rate of one mode of each pair relative to e^(-alpha t/2).
  [[nodiscard]] const std::vector<Complex>& pair_damped_omega() const { return pair_damped_omega_; }
  /// The motion after `time`; alpha time <= 4. Forces p are constant.
  void advance(const ModalPoint& from, const Amplitudes& p, double time, ModalPoint& to) const;
  /// z''
  [[nodiscard]] Amplitudes accelerations(const ModalPoint& at, const Amplitudes& p) const;
  /// Amplitude of a mode that does not oscillate: larger than any other, but finite, because zero times
  /// infinity is NaN.
  static constexpr double never = 1e300;
  /// Amplitude of each mode's oscillation about p/l; for a pair, which may grow or decay, the initial one.
  void amplitudes(const ModalPoint& at, const Amplitudes& p, std::vector<double>& real,
                  std::vector<double>& pair) const;
  /// Integrals of z over the time between the two points.
  void integrate(const ModalPoint& from, const ModalPoint& to, const Amplitudes& p, double time,
                 Amplitudes& out) const;

 private:
  void slow_by_series(const Amplitudes& p, std::size_t count, double time, ModalPoint& to) const;
  double alpha_ = 0.0;
  std::vector<double> real_, damped_omega_;
  std::vector<Complex> pairs_, pair_damped_omega_;
};

/// coefficients[j] = time^j / j! times the derivative of order j of z, 0 <= j < count.
template <class S>
void taylor_of_mode(S z, S rate, S p, S l, double alpha, double time, std::size_t count, std::size_t stride,
                    S* out) {
  out[0] = z;
  if (count > 1) out[stride] = rate * time;
  S first = z * l, second = rate * time;
  first = (p - first) * (time * time);
  for (std::size_t j = 0; j + 2 < count; ++j) {
    const double down = 1.0 / static_cast<double>(j + 2);
    const S next = first * (down / static_cast<double>(j + 1)) - second * (alpha * time * down);
    out[(j + 2) * stride] = next;
    first = second * l * (-time * time);
    second = next;
  }
}

}  // namespace signorini::modal
