// time_basis.hpp: the functions of time b(x) in the excitation of a segment, and the response of a mode with root l to b(x).
//
//   b(x) = ( 1, x, ..., x^N, cos w_1 x, sin w_1 x, ... ),   x = t - t0,   f(t) = c . b(x)
//   f' = (c D) . b  with a matrix D;  forced response c . b of z' = l z + p . b(x):  c D = l c + p
//
// On a segment, every history of a load has the form f(t) = c . b(x). The highest power of x is one more than in the forcing,
// because the response of a mode with l = 0 has one degree more.
//
// The coefficients c of a response are computed from x^N downwards, as sums of p/l, p/l^2, ... . For a root l that is slow
// relative to the segment, these terms are far greater than the response, and cancel. For such a root, c is computed
// upwards, as a power series in x:
//   c_0 = 0,   c_j+1 = (l c_j + p_j) / (j + 1),   up to x^(N+m) with (|l| x)^m / m! below rounding
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::modal {

/// Coefficients c of a function f(t) = c . b(x).
using TimeCoefficients = Eigen::VectorXd;
using ComplexTimeCoefficients = Eigen::VectorXcd;

class TimeBasis {
 public:
  TimeBasis() = default;
  /// Basis for all histories of a model, with the pieces that apply just after t; t0 = t.
  TimeBasis(const Model& model, double t);

  /// Raises the degree so that the responses of roots that are slow on [0, length] can be represented, unless the forcing is
  /// constant. length: duration of the segment. Call it before the other functions.
  void reserve_slow_roots(const Eigen::VectorXcd& roots, double length);

  [[nodiscard]] Eigen::Index size() const {
    return static_cast<Eigen::Index>(degree_ + 1 + 2 * omega_.size());
  }
  [[nodiscard]] const std::vector<double>& omega() const { return omega_; }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  /// True if the forcing is constant.
  [[nodiscard]] bool is_constant() const { return degree_ == 1 && omega_.empty(); }
  /// Values b(x) of all functions.
  [[nodiscard]] Eigen::VectorXd at(double x) const;
  /// Coefficients c of one piece of a history.
  [[nodiscard]] TimeCoefficients of(const Piece& piece) const;
  [[nodiscard]] TimeCoefficients constant(double value) const;
  /// Coefficients of time derivatives. Each row of c contains the coefficients of one function.
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::MatrixXd& c) const;
  [[nodiscard]] TimeCoefficients derivative(const TimeCoefficients& c) const;
  /// Coefficients c of the forced response, c D = l c + p. Requires l = 0 or l different from all +-i w. The coefficient of the
  /// highest power in p is not read. For slow roots the result is accurate within the length given to reserve_slow_roots().
  [[nodiscard]] ComplexTimeCoefficients response(std::complex<double> l,
                                                 const ComplexTimeCoefficients& p) const;
  /// Largest term of a response on [0, time], relative to p time. The rounding error of the response, relative to p time, is
  /// eps times this ratio. 0 if l = 0. If l is complex or positive, the terms of both roots of a mode cancel, and so do their
  /// rates: the response is then small, of the order of p time^2.
  [[nodiscard]] double cancellation(std::complex<double> l, double time) const;
  /// Expands c . b(x0 + h x) in powers of x and writes the coefficients to p, which must be longer than the degree. Waves with
  /// w h > turn are omitted. Returns bounds on the omitted waves (value) and their time derivatives (rate), and on the omitted
  /// powers of the other waves (rest).
  struct FastWaveBound {
    double value = 0.0, rate = 0.0, rest = 0.0;
  };
  [[nodiscard]] FastWaveBound taylor(const TimeCoefficients& c, double x0, double h, double turn,
                                     std::vector<double>& p) const;
  /// Integral P of b b^T over [x0, x1]. So the integral of (c . b)(d . b) is c . P d.
  [[nodiscard]] Eigen::MatrixXd products(double x0, double x1) const;

 private:
  [[nodiscard]] bool is_slow(std::complex<double> l) const {
    return l == 0.0 || std::abs(l) * length_ <= max_slow_angle;
  }

  // Largest |l| length of a slow root. At this limit, the downward terms of a response to a ramp are eight times the response.
  static constexpr double max_slow_angle = 0.5;
  double t0_ = 0.0;
  double length_ = std::numeric_limits<double>::infinity();
  std::size_t degree_ = 1, driven_ = 1;  // driven_: degree without reserve_slow_roots()
  std::vector<double> omega_;
};

}  // namespace signorini::modal
