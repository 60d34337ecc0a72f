// step_history.hpp: values of scalars at the last accepted steps, and the polynomials through these values.
//
//   p(x) interpolates f(t_n), f(t_n-1), ..., f(t_n-q),   t = t_n-1 + x (t_n - t_n-1)
//
// A BDF step of order q defines y between its ends as the polynomial through the last q + 1 accepted values.
// So a scalar that is linear in y is exactly the polynomial through its own last q + 1 values. Powers are
// products of such scalars and have a higher degree, so their polynomial interpolates all stored values.
// (Example: under a load that is a parabola in time, a step of order 4 reproduces y, but not a power.)
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/events/first_root.hpp"

namespace signorini::events {

class StepHistory {
 public:
  explicit StepHistory(std::size_t scalars)
      : scalars_(scalars), values_((max_degree + 1) * scalars), variation_bounds_(scalars), mean_(scalars) {}

  /// Deletes all values and starts at t. Returns the array into which the caller writes the values of all scalars at t.
  double* restart(double t);
  /// Adds an accepted step that ends at t. Returns the array into which the caller writes the values of all scalars at t.
  double* push(double t) { return push(t, t - times_[0]); }
  /// Same as push(t). length: step length of the integrator, which has no rounding error from t - t_previous.
  double* push(double t, double length);
  /// Computes the polynomials on the last step. order: order of the BDF method in this step.
  void prepare(int order);
  /// True if the last value of scalar i exceeds variation_bound(i): the polynomial is then positive on the whole step. False:
  /// undecided.
  [[nodiscard]] bool clearly_positive(std::size_t i) const { return value(0, i) > variation_bounds_[i]; }
  /// Bound on the difference between scalar i on the last step and its last value.
  [[nodiscard]] double variation_bound(std::size_t i) const { return variation_bounds_[i]; }
  /// True if the values of scalar i are so close to a straight line that its polynomial is monotone on the last step. False:
  /// undecided. With the distances e_b of the values from the line through the last two values, and the weights w_ib of the
  /// Bernstein coefficients:
  ///   b_i+1 - b_i = (f_0 - f_1) / q + sum_b (w_i+1,b - w_ib) e_b
  [[nodiscard]] bool clearly_monotone(std::size_t i) const;
  /// Integral of power i over the whole last step.
  [[nodiscard]] double integral(std::size_t i) const { return (times_[0] - times_[1]) * mean_[i]; }
  /// Polynomial of scalar i on the last step; its degree is the order given to prepare().
  [[nodiscard]] Bernstein polynomial(std::size_t i) const { return interpolant(order_basis(), i); }
  /// Polynomial of power i on the last step, through all stored values.
  [[nodiscard]] Bernstein power(std::size_t i) const { return interpolant(powers_basis_, i); }
  [[nodiscard]] double last(std::size_t i) const { return value(0, i); }
  /// Last values of all scalars. variation_bounds() returns variation_bound(i) for all scalars i.
  [[nodiscard]] const double* last_values() const {
    return values_.data() + static_cast<std::size_t>(slot_[0]) * scalars_;
  }
  [[nodiscard]] const double* variation_bounds() const { return variation_bounds_.data(); }
  [[nodiscard]] double begin() const { return times_[1]; }
  [[nodiscard]] double end() const { return times_[0]; }

 private:
  [[nodiscard]] double value(int back, std::size_t i) const {
    return values_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(back)]) * scalars_ + i];
  }
  /// Weights that turn the last degree + 1 values of a scalar into the polynomial through them.
  struct Basis {
    int degree = -1;
    // Nodes for which the weights below were computed. A step with the same nodes reuses the weights.
    std::array<double, max_degree + 1> nodes{};
    // to_bernstein[i][b]: weight of the value b steps back in Bernstein coefficient i
    std::array<std::array<double, max_degree + 1>, max_degree + 1> to_bernstein{};
    std::array<double, max_degree + 1> integral{};  // weight of the value b steps back in the mean
    double variation_factor = 0.0;  // greatest sum of |weights| of older values in a Bernstein coefficient
    double monotone_factor = 0.0;   // 2 q max_i sum_b |w_i+1,b - w_ib|: the factor 2 covers rounding
  };
  void prepare(Basis& basis, int degree) const;
  [[nodiscard]] const Basis& order_basis() const { return shares_basis_ ? powers_basis_ : order_basis_; }
  [[nodiscard]] Bernstein interpolant(const Basis& basis, std::size_t i) const;

  std::size_t scalars_;
  std::vector<double> values_;
  // variation_bound() of all scalars (a factor 2 covers the rounding of the sums), and the mean of each power
  // on the last step.
  std::vector<double> variation_bounds_, mean_;
  std::array<int, max_degree + 1> slot_{};        // slot_[b]: row in values_ of the values b steps back
  std::array<double, max_degree + 1> times_{};    // times_[b]: t_n-b
  std::array<double, max_degree + 1> lengths_{};  // length of the step that ended at times_[b]
  int filled_ = 0;
  bool shares_basis_ = true;  // true: scalars use powers_basis_, because their degree is that of the powers
  Basis order_basis_, powers_basis_;
};

// A guard along one step, from its values and rates at both ends.
//
//   p(x) = Hermite's cubic through g0, h g0', g1, h g1',   0 <= x <= 1
//   x*   = g0/(g0 - g1)                                    linear interpolation, (8) to (10) of Lukashevich et al. 2021
//
// For the friction limit T_U - s T, x* gives t = t0 + dt (s T_U0 - T0)/((T1 - T0) - s (T_U1 - T_U0)). If the equations
// give no rates, rates_from_values() computes rates from the parabola through the last three values.

/// A guard at the ends of a step of length h.
struct GuardCubic {
  double g0 = 0.0, g1 = 0.0;  ///< values
  double r0 = 0.0, r1 = 0.0;  ///< rates times h

  /// Place x in 0..1 at which the straight line between the ends reaches zero. Requires g0 > 0 >= g1.
  [[nodiscard]] double linear_root() const { return g0 / (g0 - g1); }
  struct ZeroCrossing {
    double x = 0.0, slope = 0.0;  ///< slope: derivative by x
  };
  /// Place x at which the cubic reaches zero. Requires g0 > 0 >= g1. nullopt: the slope at x is not negative, or is NaN.
  [[nodiscard]] std::optional<ZeroCrossing> cubic_root() const;
  /// Place x of the cubic's least value inside the step, if this value is <= 0. Requires g0 > 0 and g1 > 0.
  [[nodiscard]] std::optional<double> interior_minimum() const;
};

/// Sets the rates to those of the parabola through both ends and an earlier value: `before`, a time h_before before the step.
/// If h_before = 0, the rates are those of the straight line through both ends.
void rates_from_values(GuardCubic& path, double h, double before, double h_before);

}  // namespace signorini::events
