// friction_series.hpp: friction that depends on the slip rate, along a series of the motion.
//
//   T_k + s sum_(j = 0..k) f_j N_(k-j) = 0       f_j: contact/friction.hpp
//
// f_0 stands in the matrix of the system; what the higher ones do is known at level k, since p'_k is.
#pragma once

#include "contact/friction.hpp"
#include "motion/series.hpp"

namespace signorini {

class FrictionSeries {
 public:
  /// At the beginning of a series whose u_0 and u_1 are known. s: direction of slip; contact number `index`.
  FrictionSeries(const Contact& contact, std::size_t index, int s, const Series& series);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// f_0
  [[nodiscard]] double coefficient() const { return friction_.first(); }
  /// s sum_(j = 1..k) f_j N_(k-j); to be called for k = 0, 1, 2, ... in turn.
  [[nodiscard]] double known(int k, const Series& series);

 private:
  [[nodiscard]] double slip_rate(std::size_t k, const Series& series) const;

  const Contact* contact_;
  std::size_t index_;
  FrictionRecursion friction_;
};

}  // namespace signorini
