// jet.hpp: the motion to one side of an instant as a Taylor series, exact for the linear system of a mode.
//
//   M u^(k+2) + C u^(k+1) + K u^(k) + sum ( n N^(k) + t T^(k) ) = P^(k),   rows of the mode derived k times
//
// The derivatives are those of motion/taylor.hpp.
//
// Each jet is computed twice, the second time with data and right-hand sides disturbed by one rounding:
// the difference tells which of its entries are zero to working precision.
#pragma once

#include "contact/transition.hpp"
#include "motion/point.hpp"
#include "motion/taylor.hpp"

namespace signorini {

/// Derivatives: column k of order k. u: n rows; forces: (N_1, T_1, N_2, ...)^(k).
struct Jet {
  double t = 0.0;
  Eigen::MatrixXd u, forces;

  [[nodiscard]] auto v() const { return u.col(1); }
  [[nodiscard]] auto a() const { return u.col(2); }
};

class Expander {
 public:
  /// The orders up to which motions of contacts are needed to decide their states.
  static constexpr int orders = static_cast<int>(MotionJet::orders) - 1;

  Expander(const Model& model, const Structure& structure);

  /// Puts a mode in force. False: its rows are linearly dependent, forces would not be unique.
  bool set(const Mode& mode) { return taylor_.set(mode); }
  /// The series behind the jets, for engines that step with it.
  [[nodiscard]] Taylor& taylor() const { return taylor_; }
  /// The jet at t from u and v (v of massless degrees of freedom is not read), and the motion of every
  /// contact in it, orders 0 to `orders`, with its noise.
  [[nodiscard]] Jet expand(const Forcing& forcing, double t, const Vector& u, const Vector& v,
                           std::vector<MotionJet>& motions) const;
  /// Level 0 alone: makes forces, accelerations and v of massless degrees of freedom consistent with u, v.
  void consistent(const Forcing& forcing, double t, Point& point) const;
  /// v += the smallest impulsive change that makes t.v equal the surface velocity at contacts that stick
  /// without tangential stiffness, and n.v = 0 at closed rigid ones; u likewise, g = 0 at closed rigid ones.
  void hold(const Forcing& forcing, double t, const Mode& mode, Vector& u, Vector& v) const;

 private:
  void motions(std::vector<MotionJet>& result) const;
  void correct(const std::vector<double>& misses, Vector& x) const;

  const Model& model_;
  mutable Taylor taylor_;
  mutable Series series_, disturbed_;  // of the last jet
  int levels_;
};

}  // namespace signorini
