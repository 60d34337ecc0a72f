// friction_series.hpp: friction that depends on the slip rate, along a series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0,   f = fk + (fs - fk) E,  E = exp(g),  g = -s p' / v_s
//   k E_k = sum_(j = 1..k) j g_j E_(k-j)
//
// f_0 stands in the matrix of the system; what the higher ones do is known at level k, since p'_k is.
#pragma once

#include "motion/series.hpp"

namespace signorini {

class FrictionSeries {
 public:
  /// At the beginning of a series whose u_0 and u_1 are known. s: direction of slip; contact number `index`.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// f_0
  [[nodiscard]] double coefficient() const { return f_[0]; }
  /// s sum_(j = 1..k) f_j N_(k-j); to be called for k = 0, 1, 2, ... in turn.
  [[nodiscard]] double known(int k, const Series& series);

 private:
  [[nodiscard]] double slip_rate(Eigen::Index k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  int s_;
  std::vector<double> exponent_, f_;
};

}  // namespace signorini
