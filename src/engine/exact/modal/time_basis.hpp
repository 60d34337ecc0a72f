// time_basis.hpp: the functions of time in the excitation of a segment, and the response of a root to them.
//
//   b(x) = ( 1, x, ..., x^D, cos w_1 x, sin w_1 x, ... ),   x = t - t0,   f(t) = c . b(x)
//   f' = (c D) . b,   c D = l c + p  solved for c:  the forced part of z' = l z + p(t), besides exp(l x)
//
// Every history is such an f on a segment. The degree D is one more than the forcing's: the response without stiffness
// has one degree more.
//
// Solved backwards from x^D, the terms of c are p/l, p/l^2, ... . For a root l that is slow relative to the
// segment, these terms are far greater than the response, and cancel. The response of such a root is solved
// forwards, as a power series in x:
//   c_0 = 0,   c_j+1 = (l c_j + p_j) / (j + 1),   to the x^(D+m) with (|l| x)^m / m! below rounding
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::modal {

/// One row of coefficients.
using TimeCoefficients = Eigen::VectorXd;
using ComplexTimeCoefficients = Eigen::VectorXcd;

class TimeBasis {
 public:
  TimeBasis() = default;
  /// Basis for all histories of a model, in the pieces that are in force just after t.
  TimeBasis(const Model& model, double t);

  /// Reserves coefficients for the responses of roots that are slow on [0, length], if the forcing is not constant; for
  /// later queries. length: of the segment. Unit: time.
  void reserve_slow_roots(const Eigen::VectorXcd& roots, double length);

  [[nodiscard]] Eigen::Index size() const {
    return static_cast<Eigen::Index>(degree_ + 1 + 2 * omega_.size());
  }
  [[nodiscard]] const std::vector<double>& omega() const { return omega_; }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  /// True if the forcing is constant.
  [[nodiscard]] bool is_constant() const { return degree_ == 1 && omega_.empty(); }
  /// b(x)
  [[nodiscard]] Eigen::VectorXd at(double x) const;
  /// Coefficients of a piece of a history.
  [[nodiscard]] TimeCoefficients of(const Piece& piece) const;
  [[nodiscard]] TimeCoefficients constant(double value) const;
  /// Derivative of rows c.
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::MatrixXd& c) const;
  [[nodiscard]] TimeCoefficients derivative(const TimeCoefficients& c) const;
  /// c with c D = l c + p, for l = 0 or l different from all +-i w; the coefficient of x^D in p is not read.
  /// For slow roots the result is accurate to rounding within the length given to reserve_slow_roots().
  [[nodiscard]] ComplexTimeCoefficients response(std::complex<double> l,
                                                 const ComplexTimeCoefficients& p) const;
  /// Ratio of the response's terms to p / l on [0, time], if p is not constant: the relative rounding error
  /// of the response is eps times this ratio. 0: l = 0. If l is not real, or positive, the terms of the pair
  /// cancel, and so do their rates: the sum grows with the square of time.
  [[nodiscard]] double cancellation(std::complex<double> l, double time) const;
  /// Writes c . b(x0 + h x) in powers of x to p, whose length must exceed D. Waves with w h > turn are
  /// omitted. Returns bounds on these waves (value) and on their time derivatives (rate), and on the higher
  /// powers of the others (rest).
  struct FastWaveBound {
    double value = 0.0, rate = 0.0, rest = 0.0;
  };
  [[nodiscard]] FastWaveBound taylor(const TimeCoefficients& c, double x0, double h, double turn,
                                     std::vector<double>& p) const;
  /// Integral of b b^T over [x0, x1]: that of (c . b)(d . b) is c . products d.
  [[nodiscard]] Eigen::MatrixXd products(double x0, double x1) const;

 private:
  [[nodiscard]] bool is_slow(std::complex<double> l) const {
    return l == 0.0 || std::abs(l) * length_ <= max_slow_angle;
  }

  // At this angle the terms of a ramp, solved backwards, are eight times its response.
  static constexpr double max_slow_angle = 0.5;
  double t0_ = 0.0;
  double length_ = std::numeric_limits<double>::infinity();
  std::size_t degree_ = 1, driven_ = 1;  // driven_: degree without the terms for slow roots
  std::vector<double> omega_;
};

}  // namespace signorini::modal
