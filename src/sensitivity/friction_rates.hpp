// friction_rates.hpp: what a parameter does to friction that depends on the slip rate, along a series.
//
//   T + s f N = 0,  f = fk + (fs - fk) E,  E = exp(-x/v),  x = s ut'             contact/friction.hpp
//   T_p + s f N_p + s f_p N = 0
//   f_p = fk_p (1 - E) + fs_p E + (fs - fk) E ( x v_p/v - x_p )/v                x_p: of the tangent motion
//
// Products of series, coefficient by coefficient. f_0 stands in the matrix of the mode; at level k all else is
// known: x_k and x_p,k are of level k - 1.
#pragma once

#include "motion/series.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini {

class FrictionRates {
 public:
  /// Of contact number `index` that slips in direction s. All must outlive it.
  FrictionRates(const Contact& contact, const ContactRates& rates, std::size_t index, int s,
                const Series& motion);

  [[nodiscard]] std::size_t contact() const { return index_; }
  /// s sum_(j = 1..k) f_j N_p,(k-j) + s sum_(j = 0..k) f_p,j N_(k-j); for k = 0, 1, 2, ... in turn.
  /// slip: coefficient k of the derivative of ut' by the parameter; pressing(i): N_p,i.
  template <class Pressing>
  [[nodiscard]] double known(int k, double slip, const Pressing& pressing) {
    extend(k, slip);
    const auto level = static_cast<std::size_t>(k);
    double sum = 0.0;
    for (std::size_t j = 1; j <= level; ++j) sum += (f_.static_ - f_.kinetic) * e_[j] * pressing(level - j);
    for (std::size_t j = 0; j <= level; ++j) sum += by_p_[j] * normal(level - j);
    return s_ * sum;
  }

 private:
  struct Constants {
    double static_ = 0.0, kinetic = 0.0, velocity = 1.0;
  };
  [[nodiscard]] double normal(std::size_t i) const;
  void extend(int k, double slip);

  const Contact* contact_;
  const Series* motion_;
  std::size_t index_;
  int s_;
  Constants f_, rates_;
  std::vector<double> x_, e_, y_, by_p_;  // x, E, ( x v_p/v - x_p )/v and f_p
};

}  // namespace signorini
