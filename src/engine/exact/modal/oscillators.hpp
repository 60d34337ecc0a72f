// oscillators.hpp: the motion of uncoupled modes under constant forces, in closed form.
//
//   z'' + alpha z' + l z = p:   z - p/l = e^(-alpha t/2) ( a cos(w t) + b sin(w t) ),   w^2 = l - alpha^2/4
//
// If sqrt(l) t is small, the Taylor series in t is used instead. Its terms are polynomials in l, so zero frequencies and
// critical damping need no special cases. A mode with a complex l also represents its conjugate.
#pragma once

#include <cmath>

#include "engine/exact/modal/spectrum.hpp"

namespace signorini::modal {

/// The motion at one time. For uncoupled modes: amplitudes z and their rates. For complex modes (damped_motion.hpp): amplitudes
/// y, and the time since the beginning of the segment.
struct ModalPoint {
  Amplitudes z, rate;
  Eigen::VectorXcd y;
  double time = 0.0;
};

/// Bound on |sum_k A_k x_k| for shapes with |x_k| = 1 and A_k >= 0: the square root of the sum of A_k^2 if the x_k are
/// orthogonal, otherwise the sum of A_k.
class SumOfModes {
 public:
  /// dependence: see StepFacts::eigenvector_condition.
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
  /// w of real modes; 0 for modes that do not oscillate.
  [[nodiscard]] const std::vector<double>& damped_omega() const { return damped_omega_; }
  /// w of pairs. The imaginary part is the growth rate of one mode of the pair, relative to e^(-alpha t/2).
  [[nodiscard]] const std::vector<Complex>& pair_damped_omega() const { return pair_damped_omega_; }
  /// Computes `to`, the motion at the time `time` after `from`, under constant forces p. Requires alpha time <= 4.
  void advance(const ModalPoint& from, const Amplitudes& p, double time, ModalPoint& to) const;
  /// Accelerations z''.
  [[nodiscard]] Amplitudes accelerations(const ModalPoint& at, const Amplitudes& p) const;
  /// Amplitude of a mode that does not oscillate, used instead of infinity, because zero times infinity is NaN.
  static constexpr double never = 1e300;
  /// Computes the amplitude of the oscillation of each mode about p/l. A pair may grow or decay: its amplitude is that at `at`.
  void amplitudes(const ModalPoint& at, const Amplitudes& p, std::vector<double>& real,
                  std::vector<double>& pair) const;
  /// Computes the time integrals of z between two points. time: length of this interval.
  void integrate(const ModalPoint& from, const ModalPoint& to, const Amplitudes& p, double time,
                 Amplitudes& out) const;

 private:
  void slow_by_series(const Amplitudes& p, std::size_t count, double time, ModalPoint& to) const;
  double alpha_ = 0.0;
  std::vector<double> real_, damped_omega_;
  std::vector<Complex> pairs_, pair_damped_omega_;
};

/// Writes the Taylor terms out[j * stride] = time^j / j! d^j z / dt^j, 0 <= j < count, of a mode z'' + alpha z' + l z = p.
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
