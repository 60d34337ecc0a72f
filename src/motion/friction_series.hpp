// friction_series.hpp: friction that depends on the slip rate or on N, along a series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0       f_j: contact/friction.hpp
//
// f_0 is in the matrix of the system; the terms of the higher ones are known at level k, since p'_k is. A sliding point
// without mass (a shear element) has p'_k as an unknown of level k:
//
//   T_k + s f_0 N_k + f'(s p'_0) N_0 p'_k = -s sum' f_j N_(k-j)     sum': without the part of p'_k in f_k
//
// and p'_0 follows from T_0 (contact/massless_slip.hpp). If friction is at its greatest, or N_0 is zero, the point
// follows quasi-statically: its displacement is the unknown, and friction's coefficient is constant.
//
// For friction that depends on N, F'(|N_0|) is in the matrix (contact/friction_limit.hpp):
//   T_k + s F' N_k = s ( F_k - F' |N|_k )
#pragma once

#include <optional>

#include "contact/friction.hpp"
#include "motion/series.hpp"

namespace signorini {

class FrictionSeries {
 public:
  /// Begins a series whose u_0 and u_1 are known, u_1 for degrees of freedom with mass. s: direction of slip; contact
  /// number `index`; normal: its row.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// The tangent row in the matrix.
  [[nodiscard]] const Form& row() const { return row_; }
  /// Instantaneous displacement of a point without mass if N has decreased so far that friction does not hold it at any
  /// rate near its present one; else zero. Unit: length.
  [[nodiscard]] double jump() const { return jump_; }
  /// True if friction is at its greatest, the spring force does not determine the rate, and the growth rate of N
  /// depends on accelerations, through a dashpot: row() is that of a rate at which friction just reaches its greatest
  /// value.
  [[nodiscard]] bool doubtful() const { return doubtful_; }
  /// Changes to a point that follows quasi-statically; the accelerations require it.
  void follow_at_once();
  /// Rate along the slip in a series in which the point follows quasi-statically.
  [[nodiscard]] double rate_in(const Series& series) const { return sign_ * slip_rate(0, series); }
  [[nodiscard]] double greatest_rate() const;
  /// Known part of the row; to be called for k = 0, 1, 2, ... in turn.
  [[nodiscard]] double known(int k, const Series& series);

 private:
  void begin_by_force(const Form& normal, const Series& series);
  void begin_massless(int s, const Form& normal, const Series& series);
  [[nodiscard]] double slip_rate(std::size_t k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  int sign_;
  Form row_;
  double jump_ = 0.0;
  bool constant_ = false;  // friction's coefficient is constant
  bool doubtful_ = false;
  FrictionRecursion friction_;
  std::optional<LimitSeries> limit_;  // for friction that depends on N
};

}  // namespace signorini
