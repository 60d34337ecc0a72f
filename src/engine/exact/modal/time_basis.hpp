// time_basis.hpp: the functions of time that drive a segment, and those that answer them.
//
//   b(x) = ( 1, x, ..., x^D, cos w_1 x, sin w_1 x, ... ),   x = t - t0,   f(t) = c . b(x)
//   f' = (c D) . b,   c D = l c + p  solved for c:  what z' = l z + p(t) does besides exp(l x)
//
// Every history is such an f on a segment. D is one more than the forcing's degree: what has no stiffness
// answers one degree higher.
//
// Backwards from x^D the terms of c are p/l, p/l^2, ...: of a root that is slow beside the segment they are far greater than its
// answer, and cancel. Such a root is answered forwards, as nothing but a power of x is:
//   c_0 = 0,   c_j+1 = (l c_j + p_j) / (j + 1),   to the x^(D+m) with (|l| x)^m / m! below rounding
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// One row of coefficients.
using Course = Eigen::VectorXd;
using ComplexCourse = Eigen::VectorXcd;

class TimeBasis {
 public:
  TimeBasis() = default;
  /// Of all that acts in the pieces of a model that are in force just after t.
  TimeBasis(const Model& model, double t);

  /// Room for the answers of those roots that are slow on [0, length] where more than constants drive; of what is asked later.
  /// length: of the segment. Unit: time.
  void make_room(const Eigen::VectorXcd& roots, double length);

  [[nodiscard]] Eigen::Index size() const {
    return static_cast<Eigen::Index>(degree_ + 1 + 2 * omega_.size());
  }
  [[nodiscard]] const std::vector<double>& omega() const { return omega_; }
  [[nodiscard]] std::size_t degree() const { return degree_; }
  /// Nothing changes: what is forced, is forced by constants.
  [[nodiscard]] bool stands_still() const { return degree_ == 1 && omega_.empty(); }
  /// b(x)
  [[nodiscard]] Eigen::VectorXd at(double x) const;
  [[nodiscard]] Course of(const Piece& piece) const;
  [[nodiscard]] Course constant(double value) const;
  /// Of rows c.
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::MatrixXd& c) const;
  [[nodiscard]] Course derivative(const Course& c) const;
  /// c with c D = l c + p; l = 0 or none of +-i w: the coefficient of x^D of p is not read. Of slow roots to rounding within the
  /// length that room was made for.
  [[nodiscard]] ComplexCourse answer(std::complex<double> l, const ComplexCourse& p) const;
  /// How much greater than p / l the answer's terms are on [0, time], where p has more than a constant: the
  /// share of them that rounding leaves is that times eps. 0: l = 0. A root that is not real, or that grows, is one of a pair, whose terms
  /// cancel, and so do their rates: what is left grows with the square of time.
  [[nodiscard]] double loss(std::complex<double> l, double time) const;
  /// p[0 .. count): c . b(x0 + h x) in powers of x, count > D. Bounds on the waves with w h > turn, which are
  /// left out, and on their rates by time; and on what powers beyond make of the others.
  struct Ripple {
    double value = 0.0, rate = 0.0, rest = 0.0;
  };
  [[nodiscard]] Ripple taylor(const Course& c, double x0, double h, double turn,
                              std::vector<double>& p) const;
  /// Integral of b b^T over [x0, x1]: of (c . b)(d . b) it is c . products d.
  [[nodiscard]] Eigen::MatrixXd products(double x0, double x1) const;

 private:
  [[nodiscard]] bool is_slow(std::complex<double> l) const {
    return l == 0.0 || std::abs(l) * length_ <= slow_turn;
  }

  static constexpr double slow_turn = 0.5;  // backwards a ramp's terms are eight times its answer there
  double t0_ = 0.0;
  double length_ = std::numeric_limits<double>::infinity();
  std::size_t degree_ = 1, driven_ = 1;  // driven_: without room for slow roots
  std::vector<double> omega_;
};

}  // namespace signorini
